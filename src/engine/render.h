// The picture that an eye or camera sees of a display. Floor 2, public: threads, kernels, tiles over the optics.
#pragma once
#include "base/job.h"
#include "display/display.h"
#include "engine/estimator/summed_panel.h"
#include "geometry/geometry.h"
#include "image/image.h"
#include "image/texels.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// How a picture is rendered. Threads and kernel change no bit of it; `device` may, as a GPU renders by points.
struct RenderOptions {
    int threads = 0;           // 0: all
    std::string kernel;        // scalar | baseline | avx2 | avx512; empty: LFDSIM_KERNEL, else the best this machine has
    std::optional<Rect> crop;  // of the camera's frame; the image has the crop's size and the full frame's pixels, bit for bit
    std::optional<double> target_error = {};  // > 0, linear light: take samples until the error is below it, see refine.h
    std::string device = {};  // cpu | cuda | cuda:N | auto: a GPU where there is one; empty: LFDSIM_DEVICE, else auto
    bool rough = false;  // filtered estimator: filtered light whose error is not measured, in larger blocks; for moving pictures
};

/// A picture, and how it was rendered.
struct Rendering {
    Image image;                             // linear light, crop's or camera's size
    Image error;                             // estimated standard error of each pixel, where a target was given
    bool complete = true;                    // false: cancelled; unfinished pixels are black
    std::string device = "cpu";              // or the GPU, as in "cuda:0, NVIDIA H100"
    std::string kernel;                      // the one that ran; on a GPU its name
    int threads = 0;                         // 0 on a GPU
    Estimator estimator = Estimator::point;  // the one that was used
    std::int64_t samples = 0;                // all pixels together, with those taken to choose estimators
    double points_share = 0;                 // of the pixels of a filtered picture: by points, as measured to be needed (choice.h)
    std::optional<double> measured_error;    // of a filtered picture: root mean square, linear light, as measured at places
    double prepare_seconds = 0;              // of making the panel's tables, where they were made on the way
    double seconds = 0;                      // of rendering; with a GPU including transfers to and from it
    double gpu_seconds = 0;                  // of the GPU alone, by its clock
};

/// A kernel that is compiled in.
struct KernelInfo {
    std::string name;
    bool available;  // this machine can run it
    int lanes;       // pixels of a packet
};
/// Returns the kernels that are compiled in, best first.
std::vector<KernelInfo> kernels();

/// Returns the picture of a valid display that shows `panel` (of the panel's size). The same input and seed give the same bits with
/// any number of threads, kernel and crop. A job that is cancelled gives an incomplete picture. Throws InputError for a bad kernel,
/// device, crop, thread count, target error, number of samples or panel size, std::runtime_error where a GPU that was named fails.
Rendering render(const Display&, const Geometry&, const Texels& panel, const RenderOptions&, Job&);

/// Renders a prepared panel, which serves several views of one panel image.
Rendering render(const Display&, const Geometry&, const SummedPanel& panel, const RenderOptions&, Job&);

}  // namespace lfdsim
