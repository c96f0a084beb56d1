// Light of panels: elemental images, patterns, files. Floor 5. Shared by all visitors; all calls from any thread.
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
    Shown::Kind kind = Shown::Kind::model;  // never start
    std::string name;                     // path, built-in:spheres, or a pattern's name; empty: no model is known, as with an image
    std::int64_t changed = 0, bytes = 0;  // of a file, at the last check
    std::vector<PanelContent> objects = {};  // of scene_of_objects: each one's file
    bool operator==(const PanelContent&) const = default;
};

/// A mesh file by its path, built-in:spheres, or the display's scene_of_objects.
PanelContent model_source(const std::string& name, const Display&);

/// Throws InputError for names that a page may not use.
PanelContent source_of(const Library&, const Shown&, const Display&);

/// Everything that a panel's light depends on: equal keys mean equal bits.
/// What elemental images for the real lens depend on, too.
struct LensContent {
    PickupKind pickup;
    std::int64_t rays;
    Panel panel;
    Lens lens;
    LensArray array;
    bool operator==(const LensContent&) const = default;
};

struct PanelKey {
    PanelContent source;
    std::array<std::int64_t, 2> pixels{};
    Encoding encoding{};
    Content content;              // of a model or scene: how it stands and what lights it; else a fresh one
    std::vector<double> lengths;  // the display's numbers that elemental images and drawn patterns depend on; empty for others
    std::optional<LensContent> traced = {};  // unless the pick-up is nodal
    std::optional<Display> inverse = {};     // of the inverse pick-up: all but the place of the eye and the size of its picture
    Errors errors = {};                      // that the panel's light knows of
    bool operator==(const PanelKey&) const = default;
};
PanelKey panel_key(const PanelContent&, const Display&, const Geometry&);

class Panels {
  public:
    /// `bytes`: for all visitors together.
    explicit Panels(double bytes = free_bytes()) : budget_(bytes) {}

    /// The memory budget of all visitors together; a panel's light, a model and a scene keep their shares while they are in use.
    MemoryBudget& budget() { return budget_; }

    /// Throws InputError where the light of a panel, if it is not kept, would not fit into the memory that there is: what is kept
    /// and nobody uses is dropped for it.
    void require(const PanelKey&, const Display&);

    /// The light of a panel if it was made before and is still kept; else nothing.
    std::shared_ptr<const ShownPanel> find(const PanelKey&);

    /// Finds or makes it. Throws InputError (a model or picture that cannot be read, a panel too large for memory) and Stopped.
    std::shared_ptr<const ShownPanel> get(const PanelKey&, const Display&, const Geometry&, int threads, Job&);

    /// Makes it, and keeps only model and scene.
    std::shared_ptr<const ShownPanel> make(const PanelContent&, const Display&, const Geometry&, int threads, Job&);

    /// Reads the picture or model that a source names, and keeps it, so that errors are reported before anyone visits. Throws like
    /// get().
    void prepare(const PanelContent&, const Display&, const Geometry&, int threads, Job&);

    /// The model or scene of a source, placed at its depth in the display. Throws like get().
    ContentScene scene(const PanelContent&, const Display&, const Geometry&, Job&);

    /// The content's files, read only once for all callers, without blocking other calls. Throws like get().
    ContentParts parts(const PanelContent&, const Display&, Job&);

    /// The contents that are kept now; at most 3 panels, and 2 GiB unless a single one takes more.
    struct Kept {
        std::size_t panels, scenes, models;
        double panel_bytes;
    };
    Kept kept() const;

  private:
    MemoryBudget::Claim claim(const PanelContent&, const Display&);
    static double needed_bytes(const PanelContent&, const Display&);
    void make_room(double bytes);  // with the lists locked
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
        std::weak_ptr<const void> held;  // by each of the parts
        std::size_t count;
    };
    MemoryBudget budget_;       // outlives what is kept
    mutable std::mutex mutex_;  // of the lists; never held while something is made
    // Newest use first.
    std::list<MadePanel> panels_;
    std::list<Posed> scenes_;
    std::list<Loaded> models_;
};

}  // namespace lfdsim::view
