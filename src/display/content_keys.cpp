// The keys of [content], except those of [content.inverse].
#include "base/constants.h"
#include "display/keys.h"

namespace lfdsim {
namespace {

constexpr Range full_turn{-360, 360};

constexpr Key<Content> content_keys[] = {
    {"model", &Content::model, no_range, false,
     "Mesh file, relative to the description's folder, or built-in:spheres. Not together with [[content.object]].",
     "built-in:spheres, five chequered spheres, or the objects"},
    {"depth_mm", &Content::depth_mm, any_length, false,
     "Depth of the model's centre, from the array's viewer-side vertex plane. Objects move together; for them it is the depth "
     "midway between the centres of the nearest and the furthest one.",
     "the central depth plane of the description as written, which --set, sliders and studies do not move, or 0 where that is "
     "further from the lenses than half the viewer's distance; objects keep their "
     "places"},
    {"height_mm", &Content::height_mm, positive_length, false,
     "Height of the model. Objects: height of their common bounding box, which is scaled about the point on the display's axis at "
     "depth_mm.",
     "half the panel's height; objects keep their sizes"},
    {"tilt_deg", &Content::tilt_deg, full_turn, false,
     "Rotation of the model about the horizontal axis, before the yaw; positive raises its front. Objects rotate about the point "
     "on the display's axis at depth_mm."},
    {"yaw_deg", &Content::yaw_deg, full_turn, false,
     "Rotation of the model, counter-clockwise seen from above. Objects rotate about the same point as by tilt_deg."},
    {"viewing_distance_mm", &Content::viewing_distance_mm, Range{shortest_mm, infinity}, false,
     "Distance from the panel to the viewer for whom the elemental images are made. inf: elemental images are centred behind their "
     "lenses."},
    {"view_cone_deg", &Content::view_cone_deg, Range{0, 170, true}, false,
     "Angle that quilts made for this display span, as its maker states it. A quilt without data of its cameras is then shown as "
     "on that display: each view has an equal part of the elemental images' width.",
     "quilts are treated as pictures of cameras that span 40 degrees"},
    {"pickup", &Content::pickup, no_range, false,
     "Lines along which the scene is sampled for elemental images. nodal: through the nodal points of a perfect lens; traced: "
     "along the line on which most of a pixel's light leaves the real lens; integrated: the mean of the scene over many of a "
     "pixel's rays. inverse: the panel picture with the best views, from all rays together."},
    {"pickup_rays", &Content::pickup_rays, Range{1, 1024}, false, "Rays of the integrated pick-up for each pixel or subpixel."},
    {"inverse", &Content::inverse, no_range, false, ""},
    {"sampling", &Content::sampling, no_range, false,
     "On a panel with subpixels: each colour of a pixel is computed for the position of its subpixel, or all three for the pixel's "
     "centre."},
    {"made_for", &Content::made_for, no_range, false,
     "Display for which elemental images are made: as described, or as built, with its [errors] (calibrated content)."},
    {"light", &Content::light, no_range, false, ""},
    {"object", &Content::objects, no_range, false, ""},
};

constexpr Key<ContentLight> light_keys[] = {
    {"direction", &ContentLight::direction, any_length, false,
     "Direction towards the light, which is far away: x to the viewer's right, y up, z to the viewer. Any length but 0."},
    {"strength", &ContentLight::strength, Range{0, 100}, false, "Light that a surface facing the light adds to the ambient term."},
    {"ambient", &ContentLight::ambient, Range{0, 100}, false,
     "Share of its colour that a surface facing away from the light shows."},
};

constexpr std::string_view no_size = "given by another size; exactly one of height_mm, width_mm and unit_mm is required";

constexpr Key<SceneObject> object_keys[] = {
    {"model", &SceneObject::model, no_range, false,
     "Mesh file, relative to the description's folder, or built-in:spheres. Each object has this or image."},
    {"image", &SceneObject::image, no_range, false,
     "Picture file (PNG, JPEG, BMP, TGA, GIF), in sRGB and upright by its Exif data, relative to the same folder, on a rectangle "
     "that "
     "faces the viewer unless it is rotated. It is not lit; it is visible from both sides, mirrored from behind, and transparent "
     "where its alpha channel says so."},
    {"position_mm", &SceneObject::position_mm, any_length, false,
     "Position of the centre of the image, or of the rotated model's bounding box: x and y from the panel's centre, z from the "
     "array's viewer-side vertex plane, towards the viewer."},
    {"height_mm", &SceneObject::height_mm, positive_length, false,
     "Height of the rotated model's bounding box, or of the image before rotation.", no_size},
    {"width_mm", &SceneObject::width_mm, positive_length, false, "Width of the same box or image.", no_size},
    {"unit_mm", &SceneObject::unit_mm, positive_length, false, "Length of one unit of the model file.", no_size},
    {"roll_deg", &SceneObject::roll_deg, full_turn, false,
     "Rotation about the z axis, applied first; counter-clockwise to the viewer."},
    {"tilt_deg", &SceneObject::tilt_deg, full_turn, false, "Rotation about the x axis, after the roll; positive raises the front."},
    {"yaw_deg", &SceneObject::yaw_deg, full_turn, false,
     "Rotation about the y axis, after the tilt; counter-clockwise seen from above. All three axes are the display's."},
    {"colour", &SceneObject::colour, Range{0, 1}, false,
     "Red, green, blue as a screen shows them (sRGB), in place of the model file's colours, textures and vertex colours.",
     "as the model file says"},
    {"shading", &SceneObject::shading, no_range, false,
     "Normals of a model: those of its file, or new ones, smoothed over all edges or one for each triangle."},
};

}  // namespace

template <>
constinit const Table<Content> TableOf<Content>::table{"content", "What elemental images and reference photographs show.",
                                                       content_keys};
template <>
constinit const Table<ContentLight> TableOf<ContentLight>::table{
    "light",
    "Lighting of models. They show their colour times (ambient + strength x cosine of the angle to the light, if positive).",
    light_keys};
template <>
constinit const Table<SceneObject> TableOf<SceneObject>::table{
    "object",
    "An object of the scene, in place of content.model: a model or an image. At most 64; near objects hide those behind them.",
    object_keys};

}  // namespace lfdsim
