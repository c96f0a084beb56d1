#include "view/painting/panels.h"

#include "analysis/core/elemental_panel.h"
#include "analysis/pictures/shown_content.h"
#include "base/free_memory.h"
#include "content/models/memory.h"
#include "engine/devices/memory.h"
#include "geometry/lens_misalignment.h"
#include "geometry/resolve.h"
#include "geometry/subpixels.h"
#include "image/formats/image_file.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <utility>

namespace lfdsim::view {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_panels = 3, most_scenes = 3, most_models = 2;
constexpr double most_bytes = 2.0 * (1 << 30);
constexpr double share_of_reading = 0.5;     // of the free memory, for reading a model: pictures of others continue meanwhile
constexpr double least_for_reading = 512e6;  // half for the process that reads, whose libraries alone map more than 100 MB

/// Moves the first entry for which `is` holds to the front and returns it; null if there is none.
template <class Entry, class Is>
Entry* used(std::list<Entry>& all, const Is& is) {
    const auto found = std::find_if(all.begin(), all.end(), is);
    if (found == all.end()) return nullptr;
    all.splice(all.begin(), all, found);
    return &all.front();
}

PanelContent of_file(Shown::Kind kind, const std::string& path) {
    // An error here is reported when the file is read.
    std::error_code error;
    const auto changed = fs::last_write_time(path, error).time_since_epoch().count();
    const auto bytes = fs::file_size(path, error);
    return {kind, path, error ? 0 : std::int64_t(changed), error ? 0 : std::int64_t(bytes)};
}

/// Whether the panel's light depends on the lenses: elemental images, and patterns that are made for them.
bool drawn_for_lenses(const PanelContent& source) {
    return source.kind == Shown::Kind::model ||
           (source.kind == Shown::Kind::pattern && (source.name == "view" || source.name == "edge"));
}

/// Returns everything that a posed scene depends on except its files and its depth; other keys have their defaults, so that a
/// change of them does not change a panel's key.
Content pose_of(const Display& d, const Geometry& g) {
    Content pose = d.content;
    const Content fresh;
    pose.model.clear();  // a source says it
    pose.depth_mm.reset();
    pose.written_depth_mm.reset();
    pose.height_mm = g.content_height_mm;
    pose.viewing_distance_mm = fresh.viewing_distance_mm;
    pose.sampling = fresh.sampling;
    pose.pickup = fresh.pickup;
    pose.pickup_rays = fresh.pickup_rays;
    pose.inverse = fresh.inverse;
    return pose;
}

}  // namespace

PanelContent model_source(const std::string& name, const Display& display) {
    if (name.empty() || name == built_in_spheres) return {Shown::Kind::model, name};
    if (name != scene_of_objects) return of_file(Shown::Kind::model, name);
    PanelContent scene{Shown::Kind::model, name};
    for (const ContentFile& file : content_files(display)) scene.objects.push_back(of_file(Shown::Kind::model, file.path));
    return scene;
}

PanelContent source_of(const Library& library, const Shown& shown, const Display& display) {
    const Shown of = library.shown(shown);
    if (of.kind == Shown::Kind::pattern) return {of.kind, of.name};
    if (of.kind == Shown::Kind::panel_image) return of_file(of.kind, of.name);
    return model_source(of.name.empty() ? library.model(display) : of.name, display);
}

// The nodal pick-up (content/pickup/pickup.h) and the model's pose (content/pictures/scene.cpp) depend on these resolved numbers
// only.
PanelKey panel_key(const PanelContent& source, const Display& d, const Geometry& built) {
    const Geometry g = meant_geometry(d, built);
    PanelKey key{source, d.panel.pixels, d.panel.encoding, {}, {}};
    if (!drawn_for_lenses(source)) return key;
    key.lengths = {
        double(d.array.lattice), d.panel.pixel_pitch_mm, g.lattice.count[0],           g.lattice.count[1], d.array.pitch_mm[1],
        d.array.pitch_mm[0],     g.lattice.offset[0],    g.lattice.offset[1],          g.turn_deg,         g.gap_mm,
        g.rear_principal_mm,     g.vertex_plane_mm,      d.content.viewing_distance_mm};
    if (!knows_no_errors(d)) key.errors = d.errors;
    if (source.kind != Shown::Kind::model) return key;
    key.content = pose_of(d, g);
    key.lengths.push_back(g.content_depth_mm);
    const std::vector<double> shown = shown_places(d);
    key.lengths.insert(key.lengths.end(), shown.begin(), shown.end());
    if (d.content.pickup != PickupKind::nodal)
        key.traced = LensContent{d.content.pickup, d.content.pickup_rays, d.panel, d.lens, d.array};
    if (d.content.pickup == PickupKind::inverse) {  // it depends on the whole display, but has other eyes than the camera
        key.inverse = d;
        key.inverse->camera.resolution = {};
        if (!d.content.inverse.eyes_mm.empty() || std::isfinite(d.content.viewing_distance_mm))
            key.inverse->camera.position_mm = {};
    }
    return key;
}

std::shared_ptr<const ShownPanel> Panels::find(const PanelKey& key) {
    const std::lock_guard lock(mutex_);
    const MadePanel* const panel = used(panels_, [&](const MadePanel& p) { return p.key == key; });
    return panel ? panel->light : nullptr;
}

std::shared_ptr<const ShownPanel> Panels::get(const PanelKey& key, const Display& display, const Geometry& geometry, int threads,
                                              Job& job) {
    if (auto light = find(key)) return light;
    const std::shared_ptr<const ShownPanel> light = make(key.source, display, geometry, threads, job);
    const std::lock_guard lock(mutex_);
    // Another visitor may have made it in the meantime.
    if (const MadePanel* const panel = used(panels_, [&](const MadePanel& p) { return p.key == key; })) return panel->light;
    panels_.push_front({key, light, texel_bytes(display)});
    double bytes = 0;
    std::size_t count = 0;
    panels_.remove_if([&](const MadePanel& p) {
        bytes += p.bytes;
        return ++count > most_panels || (count > 1 && bytes > most_bytes);
    });
    return light;
}

double Panels::needed_bytes(const PanelContent& source, const Display& display) {
    return source.kind == Shown::Kind::panel_image ? texel_bytes(display) : making_panel_bytes(display);
}

bool Panels::is_read(const PartsFuture& parts) { return parts.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }

/// Drops contents that are not in use until `bytes` are free: panels, which are made most quickly, then scenes, then the models
/// that they were made from; of each, those that were not used for longest first.
void Panels::make_room(double bytes) {
    const auto drop = [&](auto& all, const auto& idle) {
        for (auto one = all.end(); one != all.begin() && !budget_.fits(bytes);)
            if (idle(*--one)) one = all.erase(one);
    };
    drop(panels_, [](const MadePanel& p) { return p.light.use_count() == 1; });
    drop(scenes_, [](const Posed& p) { return !has_copies(p.scene); });
    drop(models_, [](const Loaded& l) { return is_read(l.parts) && l.held.use_count() <= long(l.count); });
}

MemoryBudget::Claim Panels::claim(const PanelContent& source, const Display& display) {
    const double bytes = needed_bytes(source, display);
    const std::lock_guard lock(mutex_);
    make_room(bytes);
    return budget_.claim("panel.pixels", making_panel_text(display), bytes);
}

void Panels::require(const PanelKey& key, const Display& display) {
    if (!find(key)) claim(key.source, display);
}

std::shared_ptr<const ShownPanel> Panels::make(const PanelContent& source, const Display& display, const Geometry& geometry,
                                               int threads, Job& job) {
    struct Claimed {
        MemoryBudget::Claim claim;
        std::shared_ptr<const ShownPanel> light;
    };
    const auto made = std::make_shared<Claimed>();
    made->claim = claim(source, display);
    made->light = make_claimed(source, display, geometry, threads, job);
    made->claim.shrink(texel_bytes(display));
    return {made, made->light.get()};
}

std::shared_ptr<const ShownPanel> Panels::make_claimed(const PanelContent& source, const Display& display, const Geometry& geometry,
                                                       int threads, Job& job) {
    const Panel& panel = display.panel;
    if (source.kind == Shown::Kind::panel_image)
        return std::make_shared<ShownPanel>(read_panel_image(source.name, panel.encoding, panel.pixels[0], panel.pixels[1], &job),
                                            threads);
    if (source.kind == Shown::Kind::pattern)
        return std::make_shared<ShownPanel>(shown_texels(pattern(source.name, display, geometry), panel.encoding), threads);
    const ContentScene posed = scene(source, display, geometry, job);
    const Picture images = shown_content(display, geometry, posed, threads, job).picture;
    if (!images.complete) throw Stopped{};
    return std::make_shared<ShownPanel>(shown_texels(images.image, panel.encoding), threads);
}

void Panels::prepare(const PanelContent& source, const Display& display, const Geometry& geometry, int threads, Job& job) {
    if (source.kind == Shown::Kind::panel_image) {
        get(panel_key(source, display, geometry), display, geometry, threads, job);
        return;
    }
    require_panel_memory(display);
    if (source.kind == Shown::Kind::model) scene(source, display, geometry, job);
}

ContentScene Panels::scene(const PanelContent& source, const Display& display, const Geometry& geometry, Job& job) {
    if (source.kind != Shown::Kind::model || source.name.empty())
        throw InputError("shown", "is not a model: name a mesh file, or built-in:spheres");
    const Content pose = pose_of(display, geometry);
    {
        const std::lock_guard lock(mutex_);
        const auto is = [&](const Posed& p) { return p.source == source && p.pose == pose; };
        if (const Posed* const posed = used(scenes_, is)) return posed->scene.before(geometry);
    }
    const ContentParts read = parts(source, display, job);
    const double bytes = making_scene_bytes(read, display);
    const auto share = std::make_shared<MemoryBudget::Claim>();
    {
        const std::lock_guard lock(mutex_);
        make_room(bytes);
        *share = budget_.claim(model_key(display), making_scene_text(read), bytes);
    }
    const ContentScene made(read, display, geometry);
    keep(made, share);
    share->shrink(bytes_of(made));
    const std::lock_guard lock(mutex_);
    scenes_.push_front({source, pose, made});
    if (scenes_.size() > most_scenes) scenes_.pop_back();
    return made;
}

ContentParts Panels::parts(const PanelContent& source, const Display& display, Job& job) {
    if (source.name == built_in_spheres) return {built_in_model()};
    const PartsFuture future = reading(source, display);
    job.stage("model", 1);
    while (future.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
        job.advance(0);
        if (job.cancelled()) throw Stopped{};
    }
    try {
        return future.get();
    } catch (...) {  // a failed reading is forgotten, so that the next caller tries again
        const std::lock_guard lock(mutex_);
        models_.remove_if([&](const Loaded& l) { return l.source == source; });
        throw;
    }
}

// Returns the reading of a content's files, which is begun if it is not kept. A separate process reads each file, in a thread that
// continues when nobody waits any more: the next caller wants the same files.
Panels::PartsFuture Panels::reading(const PanelContent& source, const Display& display) {
    const std::lock_guard lock(mutex_);
    if (const Loaded* const loaded = used(models_, [&](const Loaded& l) { return l.source == source; })) return loaded->parts;
    const bool scene = source.name == scene_of_objects;
    struct ReadParts {
        MemoryBudget::Claim claim;
        ContentParts parts;
    };
    auto read = std::make_shared<ReadParts>();
    LoadOptions options;
    // The process that reads needs as much memory as its result. How much that is, is known only afterwards, so the most is
    // claimed.
    make_room(2 * double(options.bytes));
    const double most = std::clamp(share_of_reading * budget_.left(), least_for_reading, 2 * double(options.bytes));
    options.bytes = std::int64_t(most / 2);
    options.whose =
        fmt::format("the viewer's share for reading a model, of the {} left for all visitors", bytes_text(budget_.left()));
    read->claim = budget_.claim(model_key(display), "reading a model", most);
    const std::vector<ContentFile> files = scene ? content_files(display) : std::vector{ContentFile{source.name}};
    const std::weak_ptr<const void> held = read;
    auto load = [files, options, read = std::move(read)]() mutable {
        const auto here = std::move(read);
        here->parts = load_parts(files, options);
        here->claim.shrink(bytes_of(here->parts));
        ContentParts parts;
        for (const auto& part : here->parts) parts.emplace_back(here, part.get());
        return parts;
    };
    models_.push_front({source, std::async(std::launch::async, std::move(load)).share(), held, files.size()});
    std::size_t count = 0;
    models_.remove_if([&](const Loaded& l) {  // the removal of a future would wait for a reading that has not ended
        return ++count > most_models && is_read(l.parts);
    });
    return models_.front().parts;
}

Panels::Kept Panels::kept() const {
    const std::lock_guard lock(mutex_);
    double bytes = 0;
    for (const MadePanel& p : panels_) bytes += p.bytes;
    return {panels_.size(), scenes_.size(), models_.size(), bytes};
}

}  // namespace lfdsim::view
