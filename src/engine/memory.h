// Refuses work that needs more memory than this machine has, before it begins. Floor 2.
#pragma once
#include "model/display.h"

#include <cstdint>
#include <string>

namespace lfdsim {

/// Memory that this program may use: the machine's, or less where a control group limits it.
double memory_bytes();

/// Bytes that pictures of these sizes take, and the panel image as the renderer reads it.
double picture_bytes(std::int64_t columns, std::int64_t rows);
double texel_bytes(const Display&);

/// Throws InputError, with both figures, if `what` needs more bytes than there are; `where` names the key or option to change.
void require_memory(const std::string& where, const std::string& what, double bytes);

/// The same for a panel image that is made, not read: the picture and its texels exist at the same time while it is converted.
void require_panel_memory(const Display&);

/// The same for a picture and the panel image together; the error names the larger of the two.
void require_picture_memory(std::int64_t columns, std::int64_t rows, double panel_bytes);

}  // namespace lfdsim
