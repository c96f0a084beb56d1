// Refuses work that needs more memory than this process can have, before it begins. Floor 2.
#pragma once
#include "display/display.h"

#include <cstdint>
#include <mutex>
#include <string>

namespace lfdsim {

/// Returns the memory that this machine has in all.
double installed_bytes();
/// Returns the memory that this process can still take: free_memory() less a reserve for what is not counted; 0 at least.
double free_bytes();

/// Returns the bytes that a picture of this size takes.
double picture_bytes(std::int64_t columns, std::int64_t rows);
/// Returns the bytes that the panel image takes as the renderer reads it, with all planes and summed-area tables.
double texel_bytes(const Display&);

/// Throws InputError, with both figures, if `what` needs more bytes than are free; `where` names the key or option to change.
void require_memory(const std::string& where, const std::string& what, double bytes);

/// Returns the bytes for a panel image that is made, not read: while it is converted, picture and texels exist at the same time.
double making_panel_bytes(const Display&);
/// Returns what needs that memory, for the message of require_memory().
std::string making_panel_text(const Display&);
/// Throws InputError if a panel image that is made does not fit into memory.
void require_panel_memory(const Display&);

/// Throws InputError if a picture and a panel image of `panel_bytes` do not fit together; the error names the larger of the two.
void require_picture_memory(std::int64_t columns, std::int64_t rows, double panel_bytes);

/// Memory that several share, as the visitors of the viewer do. Who needs some claims it first, so that all together fit; a
/// claim ends with its object.
class MemoryBudget {
  public:
    explicit MemoryBudget(double bytes = free_bytes());
    MemoryBudget(const MemoryBudget&) = delete;
    MemoryBudget& operator=(const MemoryBudget&) = delete;

    class Claim {
      public:
        Claim() = default;
        Claim(Claim&&) noexcept;
        Claim& operator=(Claim&&) noexcept;
        ~Claim();
        /// Gives back what is claimed beyond `bytes`.
        void shrink(double bytes);

      private:
        friend class MemoryBudget;
        Claim(MemoryBudget& of, double bytes) : of_(&of), bytes_(bytes) {}
        MemoryBudget* of_ = nullptr;
        double bytes_ = 0;
    };
    /// Claims memory. Throws InputError, as require_memory() does, if it is not free or is claimed by others. May be called from
    /// any thread.
    [[nodiscard]] Claim claim(const std::string& where, const std::string& what, double bytes);
    bool fits(double bytes) const { return bytes <= left(); }
    /// Returns the bytes that are neither claimed nor, by the system's account, taken; 0 at least.
    double left() const;

  private:
    mutable std::mutex mutex_;
    const double bytes_;
    double claimed_ = 0;
};

}  // namespace lfdsim
