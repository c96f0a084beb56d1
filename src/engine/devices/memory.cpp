#include "engine/devices/memory.h"

#include "base/free_memory.h"
#include "base/input_error.h"
#include "geometry/subpixels.h"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lfdsim {
namespace {

/// Memory for what is not counted: threads' stacks, buffers of files, the program's tables.
constexpr double spare_bytes = 64e6;

[[noreturn]] void refuse(const std::string& where, const std::string& what, double bytes, const std::string& whose, double free) {
    throw InputError(where, fmt::format("{} needs {} of memory; {} {} free", what, bytes_text(bytes), whose, bytes_text(free)));
}

}  // namespace

double installed_bytes() { return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)); }

double free_bytes() { return std::max(free_memory().bytes - spare_bytes, 0.); }

// float32 RGB; writers keep a few rows beside it.
double picture_bytes(std::int64_t columns, std::int64_t rows) { return double(columns) * double(rows) * 12; }

// Four floats a pixel, for the panel and for each plane of subpixels; a summed-area table takes as much again.
double texel_bytes(const Display& d) {
    double pixels = 0;
    for (const PanelPlane& plane : planes(d.panel))
        pixels += std::ceil(double(d.panel.pixels[0]) / double(plane.cell[0])) *
                  std::ceil(double(d.panel.pixels[1]) / double(plane.cell[1]));
    return pixels * 16 * 2;
}

void require_memory(const std::string& where, const std::string& what, double bytes) {
    const FreeMemory free = free_memory();
    if (bytes + spare_bytes > free.bytes) refuse(where, what, bytes, free.whose, std::max(free.bytes - spare_bytes, 0.));
}

double making_panel_bytes(const Display& d) { return picture_bytes(d.panel.pixels[0], d.panel.pixels[1]) + texel_bytes(d); }

std::string making_panel_text(const Display& d) {
    return fmt::format("making the panel image of {} x {} pixels", d.panel.pixels[0], d.panel.pixels[1]);
}

void require_panel_memory(const Display& d) { require_memory("panel.pixels", making_panel_text(d), making_panel_bytes(d)); }

void require_picture_memory(std::int64_t columns, std::int64_t rows, double panel_bytes) {
    const double bytes = picture_bytes(columns, rows);
    require_memory(bytes > panel_bytes ? "camera.resolution" : "panel.pixels",
                   fmt::format("a picture of {} x {} pixels, with the panel image,", columns, rows), bytes + panel_bytes);
}

MemoryBudget::MemoryBudget(double bytes) : bytes_(bytes) {}

MemoryBudget::Claim MemoryBudget::claim(const std::string& where, const std::string& what, double bytes) {
    const std::lock_guard lock(mutex_);
    if (const double left = bytes_ - claimed_; bytes > left)
        refuse(where, what, bytes, "beside the pictures of other visitors, the viewer has", std::max(left, 0.));
    require_memory(where, what, bytes);
    claimed_ += bytes;
    return Claim(*this, bytes);
}

double MemoryBudget::left() const {
    const std::lock_guard lock(mutex_);
    return std::max(std::min(bytes_ - claimed_, free_bytes()), 0.);
}

MemoryBudget::Claim::Claim(Claim&& from) noexcept : of_(std::exchange(from.of_, nullptr)), bytes_(std::exchange(from.bytes_, 0)) {}

MemoryBudget::Claim& MemoryBudget::Claim::operator=(Claim&& from) noexcept {
    std::swap(of_, from.of_);
    std::swap(bytes_, from.bytes_);
    return *this;
}

MemoryBudget::Claim::~Claim() { shrink(0); }

void MemoryBudget::Claim::shrink(double bytes) {
    if (!of_ || bytes >= bytes_) return;
    const std::lock_guard lock(of_->mutex_);
    of_->claimed_ -= bytes_ - bytes;
    bytes_ = bytes;
}

}  // namespace lfdsim
