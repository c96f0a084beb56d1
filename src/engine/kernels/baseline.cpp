#include "engine/kernels/tile.h"
