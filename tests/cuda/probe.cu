// One sample of a pixel by each way through an array, for ptx.py: what the innermost loop of a GPU's point samples does.
#include "optics/light.h"
#include "optics/trace.h"

using namespace lfdsim;
using namespace lfdsim::optics;

template <Way through>
__device__ __forceinline__ void sample(const Scene<float>& scene, const View& view, const DirectionNumbers& directions,
                                       const PixelRays<float>& pixels, const float* texels, std::uint32_t count, float* out) {
    Sampler<float> sampler(Sampling::sobol, 2, 0, threadIdx.x);
    Light<float> light;
    for (std::uint32_t k = 0; k < count; ++k) {
        light.add(texels, Fetch<float>(trace<through>(scene, view, pixels, sampler)));
        sampler.next(directions);
    }
    for (int c = 0; c < 3; ++c) out[4 * threadIdx.x + c] = light(0, c);
}

#define PROBE(way)                                                                                                              \
    extern "C" __global__ void probe_##way(const __grid_constant__ Scene<float> scene, const __grid_constant__ View view,       \
                                           const __grid_constant__ DirectionNumbers directions, const PixelRays<float>* pixels, \
                                           const float* texels, std::uint32_t count, float* out) {                              \
        sample<Way::way>(scene, view, directions, pixels[threadIdx.x], texels, count, out);                                     \
    }
PROBE(plain)
PROBE(plain_schlick)
PROBE(plano_convex)
PROBE(strips)
PROBE(staggered)
PROBE(opaque)
PROBE(ideal)
PROBE(glass)
PROBE(other)
