// The built-in model: closed, within its box, normals outwards.
#include "content/models/model.h"
#include "small_world.h"

#include <cmath>

namespace {

using namespace small_world;

TEST(BuiltInSpheres, TrianglesLookOutwards) {
    const auto model = load_model(built_in_spheres);
    ASSERT_EQ(info(*model).textures, 5);
    const Model& m = *model;
    double volume = 0;
    for (std::size_t t = 0; t < m.triangles(); ++t) {
        const float* p[3];
        for (std::size_t k = 0; k < 3; ++k) p[k] = &m.positions[3 * m.indices[3 * t + k]];
        const float* n = &m.normals[3 * m.indices[3 * t]];
        double u[3], v[3];
        for (int c = 0; c < 3; ++c) u[c] = p[1][c] - p[0][c], v[c] = p[2][c] - p[0][c];
        const double face[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
        ASSERT_GT(face[0] * n[0] + face[1] * n[1] + face[2] * n[2], 0) << t;
        volume += (face[0] * p[0][0] + face[1] * p[0][1] + face[2] * p[0][2]) / 6;
    }
    // a mesh of 128 x 64 steps inscribed in spheres: 0.3 % less
    const double whole = 4. / 3 * std::acos(-1.) * (std::pow(0.42, 3) + 4 * std::pow(0.38, 3));
    EXPECT_NEAR(volume / whole, 1, 0.004);
    EXPECT_LT(volume, whole);
}

TEST(BuiltInSpheres, StandInAFileOfAnyFolder) {
    Display d = display();
    d.content.model = built_in_spheres;
    EXPECT_NO_THROW(ContentScene(load_model(d.content.model), d, resolve(d)));
    EXPECT_THROW(load_model("built-in:cubes"), InputError);
}

}  // namespace
