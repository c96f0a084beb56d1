#include "inverse/eye_views.h"

#include "base/input_error.h"
#include "base/vec.h"
#include "engine/render.h"
#include "geometry/camera.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace lfdsim {
namespace {

constexpr double seen_share = 0.6;  // of the gain: an element that sees less of a white panel is at the border, or between lenses
constexpr double dim_share = 0.3;   // of the brightest: an element that sees less does not count for the gain

float mean_of(const Image& image, std::size_t p) { return (image.rgb[3 * p] + image.rgb[3 * p + 1] + image.rgb[3 * p + 2]) / 3; }

/// Elements of a picture that are marked, without those next to one that is not, so many times.
std::vector<std::uint8_t> without_border(std::vector<std::uint8_t> marked, int width, int height, int times) {
    for (int t = 0; t < times; ++t) {
        const std::vector<std::uint8_t> before = marked;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx) {
                        const int i = x + dx, j = y + dy;
                        if (i < 0 || j < 0 || i >= width || j >= height ||
                            !before[std::size_t(j) * std::size_t(width) + std::size_t(i)])
                            marked[std::size_t(y) * std::size_t(width) + std::size_t(x)] = 0;
                    }
    }
    return marked;
}

}  // namespace

ContentOf photographs_of(const ContentScene& scene, int threads) {
    return [&scene, threads](const Display& seen, const Geometry& geometry, std::int64_t samples, Job& job) {
        Display camera = seen;
        camera.render.samples = samples;
        return reference_photograph(camera, geometry, scene, threads, {}, job).image;
    };
}

ContentOf pictures_of(const LightField& field, double focus_z_mm, FieldRays& rays) {
    return [&field, focus_z_mm, &rays](const Display& seen, const Geometry& geometry, std::int64_t, Job&) {
        const Camera& camera = seen.camera;
        const CameraAxes axes = camera_axes(camera);
        const Vec3d& eye = camera.position_mm;
        Image image(int(camera.resolution[0]), int(camera.resolution[1]));
        const double slope = geometry.frame_width_mm / axes.distance_mm / double(image.width);  // of a pixel
        std::int64_t unseen = 0;
        for (int row = 0; row < image.height; ++row)
            for (int column = 0; column < image.width; ++column) {
                const double right = (column + 0.5 - 0.5 * image.width) * slope, up = (0.5 * image.height - row - 0.5) * slope;
                Vec3d to = axes.forward;
                for (std::size_t c = 0; c < 3; ++c) to[c] += right * axes.right[c] + up * axes.up[c];
                const double down = (eye[2] - focus_z_mm) / -to[2], back = field.grid().distance_mm / to[2];
                const double x = eye[0] + to[0] * down, y = eye[1] + to[1] * down;
                const LightField::FieldLine line{float(x), float(y), float(x + to[0] * back), float(y + to[1] * back)};
                const auto answer = field.light(line, {float(slope), float(eye[2] - focus_z_mm)}, image.at(column, row));
                unseen += answer == LightField::Answer::beside_cameras;
            }
        rays.all += std::int64_t(image.width) * image.height;
        rays.unseen += unseen;
        return image;
    };
}

std::optional<std::vector<View>> views_of(const Request& request, const Display& display, std::span<const Eye> eyes,
                                          std::int64_t rays, std::int64_t samples, const SummedPanel& white, const char* stage) {
    const Geometry geometry = resolve(display);
    request.job.stage(stage, std::int64_t(eyes.size()));
    std::vector<std::optional<View>> made(eyes.size());
    Quiet quiet(request.job);
    tbb::parallel_for(std::size_t(0), eyes.size(), [&](std::size_t k) {
        if (request.job.cancelled()) return;
        const Eye& eye = eyes[k];
        const Display seen = display_of(request, display, geometry, eye, rays);
        const Geometry there = resolve(seen);
        Image content = eye.picture ? *eye.picture : request.content_of(seen, there, samples, quiet);
        Display filtered = seen;
        filtered.render.estimator = Estimator::filtered;
        filtered.render.samples.reset();
        RenderOptions options;
        options.threads = request.threads;  // which eyes and tiles share
        options.device = "cpu";
        Rendering bright = render(filtered, there, white, options, quiet);
        if (request.job.cancelled()) return;
        made[k] = View{ViewRows(seen, there), eye.weight, std::move(content), std::move(bright.image), {}};
        request.job.advance(1);
    });
    std::vector<View> views;
    for (std::optional<View>& view : made) {
        if (!view) return {};
        views.push_back(std::move(*view));
    }
    return views;
}

double gain_of(std::span<const View> views) {
    std::vector<float> light;
    for (const View& view : views)
        if (view.weight == 1)
            for (std::size_t p = 0; p < view.white.rgb.size() / 3; ++p) light.push_back(mean_of(view.white, p));
    const float brightest = light.empty() ? 0 : *std::max_element(light.begin(), light.end());
    std::erase_if(light, [&](float x) { return !(x >= float(dim_share) * brightest) || !(x > 0); });
    if (light.empty()) throw InputError("content.inverse.eyes_mm", "no ray from these eyes ends on the panel");
    const auto middle = light.begin() + std::ptrdiff_t(light.size() / 2);
    std::nth_element(light.begin(), middle, light.end());
    return *middle;
}

void count_elements(std::vector<View>& views, double gain, int border) {
    for (View& view : views) {
        std::vector<std::uint8_t> bright(view.white.rgb.size() / 3);
        for (std::size_t p = 0; p < bright.size(); ++p) bright[p] = mean_of(view.white, p) > float(seen_share * gain);
        view.counted = without_border(std::move(bright), view.white.width, view.white.height, border);
    }
}

}  // namespace lfdsim
