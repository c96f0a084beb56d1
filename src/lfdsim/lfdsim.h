// All that another project includes: #include <lfdsim/lfdsim.h>. examples/minimal.cpp shows how. Floor 4, public.
//
// A Display is plain data, read from a file or filled by hand; resolve() says where its parts are; elemental_images() or a picture
// file is what its panel shows; render() is what a camera sees of it; measures() are what an engineer asks of it.
#pragma once
#include "analysis/core/measure.h"           // measures(): field of view, depth of field, crosstalk ...
#include "base/input_error.h"                // InputError: what the user can fix, with place and remedy
#include "base/job.h"                        // Job: progress of long work, and its cancellation
#include "content/content.h"                 // scenes, elemental_images(), reference_photograph(), pattern()
#include "display/display.h"                 // Display: panel, lens, array, diffuser, camera, content
#include "engine/estimator/summed_panel.h"   // SummedPanel: a panel image prepared for several views of it
#include "engine/render.h"                   // render()
#include "files/description/display_file.h"  // read_display(), parse_display(), write_display()
#include "geometry/geometry.h"               // resolve(), theory(), validate()
#include "image/compare/compare.h"           // compare(): error and similarity of two pictures
#include "image/formats/image_file.h"        // read_image(), write_image(), read_panel_image()
#include "image/image.h"                     // Image: a picture in linear light
#include "image/texels.h"                    // Texels: the panel image that render() reads
#include "inverse/inverse.h"                 // invert(): the panel picture of the inverse pick-up
