// Refuses work that needs more memory than this process can have, before it begins. Floor 2.
#pragma once
#include "display/display.h"

#include <cstdint>
#include <mutex>
#include <string>

namespace lfdsim {

/// Memory that this machine has in all, and what this process can still take of it: free_memory() less a share for what is not
/// counted.
double installed_bytes();
double free_bytes();

/// Bytes that pictures of these sizes take, and the panel image as the renderer reads it.
double picture_bytes(std::int64_t columns, std::int64_t rows);
double texel_bytes(const Display&);

/// Throws InputError, with both figures, if `what` needs more bytes than are free; `where` names the key or option to change.
void require_memory(const std::string& where, const std::string& what, double bytes);

/// Bytes for a panel image that is made, not read: the picture and its texels exist at the same time while it is converted.
double making_panel_bytes(const Display&);
std::string making_panel_text(const Display&);
void require_panel_memory(const Display&);

/// Refuses a picture and the panel image that do not fit together; the error names the larger of the two.
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
        /// Gives back what is claimed beyond this.
        void shrink(double bytes);

      private:
        friend class MemoryBudget;
        Claim(MemoryBudget& of, double bytes) : of_(&of), bytes_(bytes) {}
        MemoryBudget* of_ = nullptr;
        double bytes_ = 0;
    };
    /// Throws InputError as require_memory() does, if so much is not free, or is claimed by others. From any thread.
    [[nodiscard]] Claim claim(const std::string& where, const std::string& what, double bytes);
    bool fits(double bytes) const { return bytes <= left(); }
    double left() const;

  private:
    mutable std::mutex mutex_;
    const double bytes_;
    double claimed_ = 0;
};

}  // namespace lfdsim
