// What every header of the optics builds on. Floor 1.
#pragma once
#include "base/host_device.h"

// The optics is compiled once per instruction set into one program. A separate inline namespace for each keeps the linker from
// taking one instruction set's copy of a function for another's.
#ifndef LFDSIM_ISA
#define LFDSIM_ISA generic
#endif
