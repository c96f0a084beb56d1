// Light of panels: elemental images, patterns, files. Floor 5. Shared by all visitors; all calls from any thread.
#pragma once
#include "analysis/subject.h"
#include "view/library.h"

#include <array>
#include <cstdint>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace lfdsim::view {

/// What a panel shows, with names resolved to files.
struct Source {
    Shown::Kind kind = Shown::Kind::model;  // never start
    std::string name;                       // path, built-in:spheres, or a pattern's name; empty: no model is known, as of an image
    std::int64_t changed = 0, bytes = 0;    // of a file, when it last was looked at
    bool operator==(const Source&) const = default;
};

/// A mesh file by its path, or built-in:spheres.
Source model_source(const std::string& name);

/// Throws InputError for what a page may not name.
Source source_of(const Library&, const Shown&, const Display&);

/// All that a panel's light depends on: equal keys, equal bits.
struct PanelKey {
    Source source;
    std::array<std::int64_t, 2> pixels{};
    Encoding encoding{};
    std::vector<double> lengths;  // what elemental images and drawn patterns read of the display; empty for others
    bool operator==(const PanelKey&) const = default;
};
PanelKey panel_key(const Source&, const Display&, const Geometry&);

class Panels {
  public:
    /// The light of a panel that was made before and is still kept; else nothing.
    std::shared_ptr<const ShownPanel> find(const PanelKey&);

    /// Finds or makes it. Throws InputError (a model or picture that cannot be read, a panel too large for the memory) and Stopped.
    std::shared_ptr<const ShownPanel> get(const PanelKey&, const Display&, const Geometry&, int threads, Job&);

    /// Makes it, and keeps nothing but model and scene.
    std::shared_ptr<const ShownPanel> make(const Source&, const Display&, const Geometry&, int threads, Job&);

    /// Reads the picture or the model that a source names, and keeps it, so that what cannot be shown is told before anyone looks.
    /// Throws like get().
    void prepare(const Source&, const Display&, const Geometry&, int threads, Job&);

    /// The model of a source in its place before the display. Throws like get().
    ContentScene scene(const Source&, const Display&, const Geometry&, Job&);

    /// The model itself, read once whoever asks, while others go on. Throws like get().
    std::shared_ptr<const Model> model(const Source&, Job&);

    /// What is kept now; at most 3 panels, and 2 GiB unless a single one takes more.
    struct Kept {
        std::size_t panels, scenes, models;
        double panel_bytes;
    };
    Kept kept() const;

  private:
    using ModelFuture = std::shared_future<std::shared_ptr<const Model>>;
    ModelFuture reading(const Source&);

    struct Made {
        PanelKey key;
        std::shared_ptr<const ShownPanel> light;
        double bytes;
    };
    struct Posed {
        Source source;
        std::array<double, 3> pose;  // tilt, yaw, height
        ContentScene scene;
    };
    struct Loaded {
        Source source;
        ModelFuture model;
    };
    mutable std::mutex mutex_;  // of the lists; never held while something is made
    // Newest use first.
    std::list<Made> panels_;
    std::list<Posed> scenes_;
    std::list<Loaded> models_;
};

}  // namespace lfdsim::view
