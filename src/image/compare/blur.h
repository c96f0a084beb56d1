// Gaussian blur of pictures, of any number of channels. Floor 0.
#pragma once
#include <vector>

namespace lfdsim {

/// Convolves each channel of `values`, rows x columns x channels, with a Gaussian of standard deviation `sigma` pixels, sampled at
/// pixels, cut at 4 sigma and normalised; beyond the border the last pixel is repeated. At sigma below 0.5 the samples are too far
/// apart to keep the variance, and below 0.25 nothing changes. The bits are the same on any number of threads.
void blur(std::vector<float>& values, int columns, int rows, int channels, double sigma);

}  // namespace lfdsim
