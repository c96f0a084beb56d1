// Refuses work that this machine has not the memory for, before it begins. Floor 2.
#pragma once
#include "model/display.h"

#include <cstdint>
#include <string>

namespace lfdsim {

/// Memory that this program may use: the machine's, or less where a control group says so.
double memory_bytes();

/// Bytes that pictures of these sizes take, and the panel image as the renderer reads it.
double picture_bytes(std::int64_t columns, std::int64_t rows);
double texel_bytes(const Display&);

/// Throws InputError with both figures if `bytes` for `what` is more than there is; `where` names the key or option to change.
void require_memory(const std::string& where, const std::string& what, double bytes);

/// The same for a panel image that is made, not read: a picture first, beside its texels while it turns into them.
void require_panel_memory(const Display&);

/// The same for a picture beside what the panel image takes; the larger of the two is named.
void require_picture_memory(std::int64_t columns, std::int64_t rows, double panel_bytes);

}  // namespace lfdsim
