// What the panel shows: scenes, elemental images, test patterns, reference photographs. Floor 2, public.
#pragma once
#include "base/input_error.h"
#include "base/job.h"
#include "display/display.h"
#include "geometry/geometry.h"
#include "image/image.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// A mesh as read: not yet posed. Loaded in a child process with limits on time and memory.
class Model;

/// Numbers of a model, and what happened while it was read.
struct ModelInfo {
    std::int64_t triangles, vertices, materials, textures;
    std::vector<std::string> notes;  // what was dropped or repaired, in words
    // The files that were read: the model's own, and those that it names; none for the built-in one
    std::vector<std::string> files;
};

/// Limits and options of reading a model or a picture.
struct LoadOptions {
    double seconds = 60;                         // of the child process: elapsed time, and processor time
    std::int64_t bytes = std::int64_t(4) << 30;  // address space of the child process, and the most that it may send
    std::string up;                              // the file's axis that points up: "y" or "z"; "" by format
    const Job* job = nullptr;                    // may cancel the reading, which then throws as if the file could not be read
    std::string whose = "the most that reading a file may take";  // what the limit `bytes` is, for the message if it is exceeded
};

/// The name, in place of a model file's, of the built-in model: five chequered spheres at five depths.
inline constexpr std::string_view built_in_spheres = "built-in:spheres";
std::shared_ptr<const Model> built_in_model();

/// A file that content is read from.
struct ContentFile {
    std::string path;    // or built-in:spheres
    bool image = false;  // a picture, not a model
    auto operator<=>(const ContentFile&) const = default;
};
/// Returns the files of what a display shows: those of its objects in their order; without objects that of content.model, or the
/// built-in one.
std::vector<ContentFile> content_files(const Display&);

/// The name of the scene of a description with objects, which have no common file.
inline constexpr std::string_view scene_of_objects = "content.object";
/// Returns the name of what a display shows: the model's, or scene_of_objects.
std::string model_of(const Display&);

/// Returns the built-in model, or that of a file. Throws InputError, which names the file, if it is missing or unreadable, has an
/// unknown format or no triangles, or crashes or exhausts the reader; std::runtime_error if the reader program
/// lfdsim-model-reader is missing.
std::shared_ptr<const Model> load_model(const std::filesystem::path&, const LoadOptions& = {});
/// Returns a picture (PNG, JPEG, BMP, TGA, the first frame of a GIF) as a rectangle of height 1 about the origin that faces +z.
/// Throws as load_model().
std::shared_ptr<const Model> load_picture(const std::filesystem::path&, const LoadOptions& = {});
ModelInfo info(const Model&);

/// The models and pictures of content_files(), in their order. load_parts() reads each file once; the limits hold for all files
/// together.
using ContentParts = std::vector<std::shared_ptr<const Model>>;
ContentParts load_parts(const std::vector<ContentFile>&, const LoadOptions& = {});

/// What a display shows, posed in front of the display (docs/model.md, "Pose"), with its ray-tracing structure. Copies share
/// both. Lengths are in the display's frame.
class ContentScene {
  public:
    /// `parts`: those of the display's content_files(). Throws InputError for a model without height (lying flat) or millions of
    /// times wider than high, and if there is not enough memory.
    ContentScene(const ContentParts&, const Display&, const Geometry&);
    /// The scene of a display without objects.
    ContentScene(std::shared_ptr<const Model> model, const Display& d, const Geometry& g)
        : ContentScene(ContentParts{std::move(model)}, d, g) {}

    /// Returns the scene at another depth (content.depth_mm), mm from the vertex plane, of the same display: nothing is read,
    /// posed or built again, and pictures have the bits of a scene made there. Throws InputError for a depth that a display could
    /// not have.
    ContentScene at_depth(double depth_mm) const;

    /// Returns the scene in front of another display, with the same content at perhaps another depth; the geometry is that
    /// display's.
    ContentScene before(const Geometry&) const;

    struct Impl;
    const Impl& impl() const { return *impl_; }
    /// Returns the centre of the model's box, from the panel's centre; of objects the reference point that content.depth_mm
    /// moves.
    Vec3d centre_mm() const { return {0, 0, vertex_plane_mm_ + depth_mm_}; }
    /// Returns the files that the scene was read from: models, those that they name, and pictures; none of built-in ones.
    const std::vector<std::string>& files() const;
    /// Returns how far the scene extends from there along x, y and z: half the extents of the model's box.
    Vec3d half_size_mm() const;

  private:
    std::shared_ptr<const Impl> impl_;
    double vertex_plane_mm_, depth_mm_;
};

/// Returns ContentScene::half_size_mm() of a scene without making its ray-tracing structure. Throws as the constructor.
Vec3d half_size_mm(const ContentParts&, const Display&, const Geometry&);

/// A picture of content.
struct Picture {
    Image image;            // linear light
    bool complete = true;   // false: cancelled
    std::int64_t rays = 0;  // number of rays cast, shaded or background
    std::int64_t dark = 0;  // panel pixels (subpixels, if each has its rays) whose light does not leave their lens: black
    double seconds = 0;     // time that casting took
};

/// Returns the elemental images by the display's pick-up, of the panel's size: one ray (integrated: content.pickup_rays) for each
/// panel pixel that a lens owns, and for each channel if these are made for different points. 0 threads: one for each processor;
/// the bits do not depend on their number. Throws InputError for a bad number of threads; std::logic_error for the inverse
/// pick-up, which is in inverse/inverse.h.
Picture elemental_images(const Display&, const Geometry&, const ContentScene&, int threads, Job&);

/// Returns the scene as the display's camera sees it directly: one ray through each pixel's centre, or, with a pupil or a pixel
/// filter, the display's samples (100 by default) spread over both as in a rendering by points. A crop has the full frame's
/// pixels, bit for bit. Throws InputError for a crop outside the frame or a bad number of threads.
Picture reference_photograph(const Display&, const Geometry&, const ContentScene&, int threads, std::optional<Rect> crop, Job&);

/// Returns the names of the test patterns: "checkerboard", "white", "view" (one view white), "edge" (a slanted edge), "address"
/// (each pixel's codes are its column and row). docs/model.md, "Test patterns".
std::vector<std::string> pattern_names();
/// Options of test patterns.
struct PatternOptions {
    int cell_pixels = 11;           // checkerboard: side of a square, panel pixels
    double view_x = 0, view_y = 0;  // view: position in the elemental image, from its centre, -0.5 to 0.5 of its width and height
    double edge_deg = 5;            // edge: slant from the vertical, counter-clockwise
    double depth_mm = 0;            // edge: depth from the vertex plane
};
/// Returns a pattern of the panel's size in linear light, such that the panel's encoding gives the intended codes. Throws
/// InputError for an unknown name, and for options out of range.
Image pattern(const std::string& name, const Display&, const Geometry&, const PatternOptions& = {});

}  // namespace lfdsim
