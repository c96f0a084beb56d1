// The light of panels, elemental images, patterns and files, made once for all visitors. Floor 5. All calls from any thread.
#pragma once
#include "analysis/core/elemental_panel.h"
#include "analysis/core/subject.h"
#include "engine/devices/memory.h"
#include "view/answers/library.h"

#include <array>
#include <cstdint>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::view {

/// The content of a panel, with names resolved to files.
struct PanelContent {
    Shown::Kind kind = Shown::Kind::model;  // never `start`
    std::string name;                     // path, built-in:spheres, or a pattern's name; empty: no model is known, as with an image
    std::int64_t changed = 0, bytes = 0;  // time of change and size of a file, at the last check
    std::vector<PanelContent> objects = {};  // of scene_of_objects: the file of each
    bool operator==(const PanelContent&) const = default;
};

/// Returns the content of a name: a mesh file by its path, built-in:spheres, or the display's scene_of_objects.
PanelContent model_source(const std::string& name, const Display&);

/// Returns the content that a page wants to show. Throws InputError for names that a page may not use.
PanelContent source_of(const Library&, const Shown&, const Display&);

/// The parts of a display that elemental images for the real lens depend on, in addition to those of nodal ones.
struct LensContent {
    PickupKind pickup;
    std::int64_t rays;
    Panel panel;
    Lens lens;
    LensArray array;
    bool operator==(const LensContent&) const = default;
};

/// Everything that a panel's light depends on: equal keys mean equal bits.
struct PanelKey {
    PanelContent source;
    std::array<std::int64_t, 2> pixels{};
    Encoding encoding{};
    Content content;              // of a model or scene: its pose and its light; else a fresh one
    std::vector<double> lengths;  // the display's numbers that elemental images and patterns for lenses depend on; empty for others
    std::optional<LensContent> traced = {};  // unless the pick-up is nodal
    std::optional<Display> inverse = {};     // of the inverse pick-up: all but the eye's position and the size of its picture
    Errors errors = {};                      // that the panel's light takes into account
    bool operator==(const PanelKey&) const = default;
};
PanelKey panel_key(const PanelContent&, const Display&, const Geometry&);

/// Keeps the panels, scenes and models that were used last. All functions that make something throw InputError (a model or picture
/// that cannot be read, a panel too large for memory) and, where the job is cancelled, Stopped.
class Panels {
  public:
    /// `bytes`: the memory for all visitors together.
    explicit Panels(double bytes = free_bytes()) : budget_(bytes) {}

    /// The memory budget of all visitors together; a panel's light, a model and a scene keep their shares while they are in use.
    MemoryBudget& budget() { return budget_; }

    /// Throws InputError where the light of a panel is not kept and would not fit into the memory. What is kept and not in use is
    /// dropped for it.
    void require(const PanelKey&, const Display&);

    /// Returns the light of a panel if it is kept; else null.
    std::shared_ptr<const ShownPanel> find(const PanelKey&);

    /// Returns the light of a panel, and makes and keeps it if it is not kept.
    std::shared_ptr<const ShownPanel> get(const PanelKey&, const Display&, const Geometry&, int threads, Job&);

    /// Makes the light of a panel, and keeps only model and scene.
    std::shared_ptr<const ShownPanel> make(const PanelContent&, const Display&, const Geometry&, int threads, Job&);

    /// Reads the picture or model that a source names, and keeps it, so that errors are reported before anyone visits.
    void prepare(const PanelContent&, const Display&, const Geometry&, int threads, Job&);

    /// Returns the model or scene of a source, placed at its depth in the display.
    ContentScene scene(const PanelContent&, const Display&, const Geometry&, Job&);

    /// Returns the content's files, read only once for all callers, without blocking other calls.
    ContentParts parts(const PanelContent&, const Display&, Job&);

    /// The numbers of contents that are kept; at most 3 panels, of 2 GiB together unless a single one takes more.
    struct Kept {
        std::size_t panels, scenes, models;
        double panel_bytes;
    };
    Kept kept() const;

  private:
    MemoryBudget::Claim claim(const PanelContent&, const Display&);
    static double needed_bytes(const PanelContent&, const Display&);
    void make_room(double bytes);  // called with the mutex held
    std::shared_ptr<const ShownPanel> make_claimed(const PanelContent&, const Display&, const Geometry&, int threads, Job&);

    using PartsFuture = std::shared_future<ContentParts>;
    static bool is_read(const PartsFuture&);
    PartsFuture reading(const PanelContent&, const Display&);

    struct MadePanel {
        PanelKey key;
        std::shared_ptr<const ShownPanel> light;
        double bytes;
    };
    struct Posed {
        PanelContent source;
        Content pose;
        ContentScene scene;
    };
    struct Loaded {
        PanelContent source;
        PartsFuture parts;
        std::weak_ptr<const void> held;  // by each of the parts; more uses than `count` mean that somebody uses one
        std::size_t count;               // of the parts
    };
    MemoryBudget budget_;       // declared first, since it must outlive what is kept
    mutable std::mutex mutex_;  // protects the lists; never held while something is made
    // Lists are in the order of use, the newest first.
    std::list<MadePanel> panels_;
    std::list<Posed> scenes_;
    std::list<Loaded> models_;
};

}  // namespace lfdsim::view
