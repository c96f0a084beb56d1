// One sample of a pixel by each specialisation of the tracer, for ptx.py: what the innermost loop of a GPU's point samples does.
#include "optics/light.h"
#include "optics/trace.h"

using namespace lfdsim;
using namespace lfdsim::optics;

template <Facts facts>
__device__ __forceinline__ void sample(const TracedDisplay<float>& scene, const RayOrigin& view, const DirectionNumbers& directions,
                                       const PixelRays<float>& pixels, const float* texels, std::uint32_t count, float* out) {
    Sampler<float> sampler(Sampling::sobol, 2, 0, threadIdx.x);
    Light<float> light;
    for (std::uint32_t k = 0; k < count; ++k) {
        light.add(texels, Fetch<float>(trace<facts>(scene, view, pixels, sampler)));
        sampler.next(directions);
    }
    for (int c = 0; c < 3; ++c) out[4 * threadIdx.x + c] = light(0, c);
}

#define PROBE(facts)                                                                                                              \
    extern "C" __global__ void probe_##facts(const __grid_constant__ TracedDisplay<float> scene,                                  \
                                             const __grid_constant__ RayOrigin view,                                              \
                                             const __grid_constant__ DirectionNumbers directions, const PixelRays<float>* pixels, \
                                             const float* texels, std::uint32_t count, float* out) {                              \
        sample<Specialisations::facts>(scene, view, directions, pixels[threadIdx.x], texels, count, out);                         \
    }
PROBE(paper_plain)
PROBE(paper_plain_schlick)
PROBE(paper)
PROBE(paper_strips)
PROBE(paper_staggered)
PROBE(opaque)
PROBE(ideal)
PROBE(lit_between)
PROBE(others)
