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

struct ModelInfo {
    std::int64_t triangles, vertices, materials, textures;
    std::vector<std::string> notes;  // what was dropped or repaired, in words
    std::vector<std::string> files;  // that were read: the model's own, and those that it names; none for a built-in one
};

struct LoadOptions {
    double seconds = 60;                         // of the child process: wall clock, and processor time
    std::int64_t bytes = std::int64_t(4) << 30;  // its address space, and what it may send
    std::string up;                              // the file's axis that points up: "y" or "z"; "" by format
    const Job* job = nullptr;                    // may cancel the reading, which then throws as where a file cannot be read
    std::string whose = "the most that reading a file may take";  // what limit `bytes` is, for the message where it is met
};

/// A model file's name for the model that is built in: five chequered spheres at five depths.
inline constexpr std::string_view built_in_spheres = "built-in:spheres";
std::shared_ptr<const Model> built_in_model();

/// A file that content comes from.
struct ContentFile {
    std::string path;    // or built-in:spheres
    bool image = false;  // a picture, not a model
    auto operator<=>(const ContentFile&) const = default;
};
/// What a display shows: the file of each object in their order; without objects that of content.model, or of the built-in one.
std::vector<ContentFile> content_files(const Display&);

/// What stands for the name of a model where a description has objects.
inline constexpr std::string_view scene_of_objects = "content.object";
/// The name of what a display shows: the model's, or that.
std::string model_of(const Display&);

/// The built-in model, or that of a file. Throws InputError that names the file if it is missing or unreadable, has an unknown
/// format or no triangles, or crashes or exhausts the reader; std::runtime_error if the reader program lfdsim-model-reader is
/// missing.
std::shared_ptr<const Model> load_model(const std::filesystem::path&, const LoadOptions& = {});
/// A picture on a rectangle of height 1 about the origin, facing +z, by the same rules: PNG, JPEG, BMP, TGA, GIF (its first
/// frame).
std::shared_ptr<const Model> load_picture(const std::filesystem::path&, const LoadOptions& = {});
ModelInfo info(const Model&);

/// The models and pictures of content_files(), which are read once each. The limits hold for all of them together.
using ContentParts = std::vector<std::shared_ptr<const Model>>;
ContentParts load_parts(const std::vector<ContentFile>&, const LoadOptions& = {});

/// What a display shows, posed in front of the display (docs/model.md, "Pose"), with its ray-tracing structure. Copies share
/// both.
class ContentScene {
  public:
    /// Throws InputError for a model without height (lying flat) or millions of times wider than high. `parts`: those of the
    /// display's content_files().
    ContentScene(const ContentParts&, const Display&, const Geometry&);
    /// The scene of a display without objects.
    ContentScene(std::shared_ptr<const Model> model, const Display& d, const Geometry& g)
        : ContentScene(ContentParts{std::move(model)}, d, g) {}

    /// The scene at another depth (content.depth_mm) of the same display: nothing is read, posed or built again, and pictures
    /// have the bits of a scene made there. Throws InputError for a depth that a display could not have.
    ContentScene at_depth(double depth_mm) const;

    /// The scene in front of another display, resolved, with the same content at perhaps another depth.
    ContentScene before(const Geometry&) const;

    struct Impl;
    const Impl& impl() const { return *impl_; }
    /// The middle of the model's box, from the middle of the panel; of objects the point that content.depth_mm is of.
    Vec3d centre_mm() const { return {0, 0, vertex_plane_mm_ + depth_mm_}; }
    /// How far it reaches from there along x, y and z: half the extents of the model's box.
    Vec3d half_size_mm() const;

  private:
    std::shared_ptr<const Impl> impl_;
    double vertex_plane_mm_, depth_mm_;
};

/// ContentScene::half_size_mm() of such a scene, which is not made. Throws as its constructor.
Vec3d half_size_mm(const ContentParts&, const Display&, const Geometry&);

struct Picture {
    Image image;            // linear light
    bool complete = true;   // false: cancelled
    std::int64_t rays = 0;  // cast (shaded or background)
    std::int64_t dark = 0;  // panel pixels (subpixels, where each has rays of its own) whose light never leaves their lens: black
    double seconds = 0;
};

/// Elemental images by the display's pick-up, one ray (integrated: content.pickup_rays) for each panel pixel that a lens owns;
/// the panel's size. threads 0: all. The same bits for any number of threads. Throws InputError for a bad thread count;
/// std::logic_error for the inverse pick-up, which inverse/inverse.h has.
Picture elemental_images(const Display&, const Geometry&, const ContentScene&, int threads, Job&);

/// The scene seen directly by the display's camera: one ray through each pixel's centre, or, with a pupil or a pixel filter,
/// the display's samples (100 by default) spread over both as in a rendering, whatever its estimator. A crop has the full
/// frame's pixels, bit for bit. Throws InputError for a crop outside the frame or a bad thread count.
Picture reference_photograph(const Display&, const Geometry&, const ContentScene&, int threads, std::optional<Rect> crop, Job&);

/// Test patterns of the panel's size: "checkerboard", "white", "view" (one view white), "edge" (slanted edge), "address"
/// (ramp).
std::vector<std::string> pattern_names();
struct PatternOptions {
    int cell_pixels = 11;           // checkerboard
    double view_x = 0, view_y = 0;  // view: which, -0.5 .. 0.5 of the elemental image from its centre
    double edge_deg = 5;            // edge: slant
    double depth_mm = 0;            // edge: where it stands, from the vertex plane
};
/// Linear light, such that writing it with the panel's encoding gives the intended code values. Throws InputError for an
/// unknown name.
Image pattern(const std::string& name, const Display&, const Geometry&, const PatternOptions& = {});

}  // namespace lfdsim
