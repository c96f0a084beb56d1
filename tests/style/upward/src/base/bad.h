// Includes a higher floor: the layering check must find it.
#include "engine/render.h"
