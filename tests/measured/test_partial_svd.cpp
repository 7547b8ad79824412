// Partial against full singular value decomposition, and both against matrices made from known ones.
#include <gtest/gtest.h>

#include <numeric>

#include "nacre/math/random.h"
#include "nacre/measured/factor/matrix.h"
#include "nacre/measured/factor/partial_svd.h"

namespace nacre {
namespace {

using Numbers = std::vector<double>;

Numbers random_vector(int n, int key) {
    Random random(stream_key(11, key));
    Numbers v(n);
    for (double& x : v) x = random.next() - 0.5;
    return v;
}

double product(const Numbers& a, const Numbers& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

/// H(p) diag(sigma) H(q), H(p) = 1 - 2 p p^T/|p|^2: its singular values are |sigma|.
Numbers matrix_of(const Numbers& sigma, const Numbers& p, const Numbers& q) {
    const int n = int(sigma.size());
    const double pp = product(p, p), qq = product(q, q);
    Numbers m(std::size_t(n) * n);
    for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l)
            for (int j = 0; j < n; ++j)
                m[std::size_t(k) * n + l] += ((k == j) - 2. * p[k] * p[j] / pp) * sigma[j] *
                                             ((j == l) - 2. * q[j] * q[l] / qq);
    return m;
}

/// Orthonormal vectors, and M v = sigma u.
void expect_vectors(const Numbers& m, int n, const Svd& svd) {
    for (std::size_t i = 0; i < svd.sigma.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            EXPECT_NEAR(product(svd.u[i], svd.u[j]), double(i == j), 1e-9);
            EXPECT_NEAR(product(svd.v[i], svd.v[j]), double(i == j), 1e-9);
        }
        for (int k = 0; k < n; ++k) {
            double sum = 0.;
            for (int l = 0; l < n; ++l) sum += m[std::size_t(k) * n + l] * svd.v[i][l];
            EXPECT_NEAR(sum, svd.sigma[i] * svd.u[i][k], 1e-9 * svd.sigma[0]);
        }
    }
}

Numbers brdf_matrix(const char* model, int side) {
    const FactorGrid grid{FactorParameters::in_out, side};
    return sample_matrix(*make_target(model), grid).values[0];
}

}  // namespace

TEST(PartialSvd, FindsWhatTheMatrixIsMadeOf) {
    const int n = 60;
    Numbers sigma(n);
    for (int j = 0; j < n; ++j) sigma[j] = std::pow(0.7, j);
    const Numbers m = matrix_of(sigma, random_vector(n, 1), random_vector(n, 2));
    for (const Svd& svd : {partial_svd(m, n, 8), full_svd(m, n)}) {
        for (int j = 0; j < 8; ++j) EXPECT_NEAR(svd.sigma[j], sigma[j], 1e-12);
        expect_vectors(m, n, svd);
    }
    EXPECT_EQ(partial_svd(m, n, 8).sigma.size(), 8u);
    EXPECT_EQ(partial_svd(m, n, 50).sigma.size(), 50u);
    EXPECT_EQ(partial_svd(m, n, 99).sigma.size(), 60u);
}

// Eigenvalues of either sign, the largest of them negative.
TEST(PartialSvd, SymmetricMatrices) {
    const int n = 50;
    Numbers sigma(n);
    for (int j = 0; j < n; ++j) sigma[j] = (j % 3 == 0 ? -1. : 1.) * std::pow(0.8, j);
    const Numbers p = random_vector(n, 3), m = matrix_of(sigma, p, p);
    ASSERT_TRUE(is_symmetric(m, n));
    const Svd svd = partial_svd(m, n, 10);
    for (int j = 0; j < 10; ++j) EXPECT_NEAR(svd.sigma[j], std::pow(0.8, j), 1e-12);
    expect_vectors(m, n, svd);
    Numbers other = m;
    other[7] += 1e-6;
    EXPECT_FALSE(is_symmetric(other, n));
}

TEST(PartialSvd, ValuesThatComeMoreThanOnce) {
    const int n = 64;
    Numbers sigma(n, 0.01);
    for (int j = 0; j < 10; ++j) sigma[j] = j < 2 ? 3. : j < 6 ? 2. : 1.;
    const Numbers m = matrix_of(sigma, random_vector(n, 4), random_vector(n, 5));
    const Svd svd = partial_svd(m, n, 10);
    for (int j = 0; j < 10; ++j) EXPECT_NEAR(svd.sigma[j], sigma[j], 1e-9);
    expect_vectors(m, n, svd);
}

TEST(PartialSvd, LowerRankThanAskedFor) {
    const int n = 48;
    Numbers sigma(n, 0.);
    sigma[0] = 5.;
    sigma[1] = 2.;
    const Numbers p = random_vector(n, 6);
    for (const Numbers& m : {matrix_of(sigma, p, p), matrix_of(sigma, p, random_vector(n, 7)),
                             Numbers(std::size_t(n) * n, 0.5)}) {
        const Svd svd = partial_svd(m, n, 6);
        ASSERT_EQ(svd.sigma.size(), 6u);
        for (int j = 2; j < 6; ++j) EXPECT_NEAR(svd.sigma[j], 0., 1e-9);
        double all = 0.;
        for (double x : m) all += x * x;
        EXPECT_NEAR(std::hypot(svd.sigma[0], svd.sigma[1]), std::sqrt(all), 1e-9);
    }
}

// ||M - M_J||^2 is the sum of the squares that are left out, and no other M_J of the rank is nearer.
TEST(PartialSvd, EckartYoung) {
    const int n = 40;
    const Numbers m = random_vector(n * n, 8);
    const Svd full = full_svd(m, n);
    for (int terms : {1, 3, 8}) {
        const Svd svd = partial_svd(m, n, terms);
        double left = 0., out = 0.;
        for (int k = 0; k < n; ++k)
            for (int l = 0; l < n; ++l) {
                double rest = m[std::size_t(k) * n + l];
                for (int j = 0; j < terms; ++j) rest -= svd.sigma[j] * svd.u[j][k] * svd.v[j][l];
                left += rest * rest;
            }
        for (int j = terms; j < n; ++j) out += full.sigma[j] * full.sigma[j];
        EXPECT_NEAR(left, out, 1e-10 * out);
    }
}

TEST(PartialSvd, AgreesWithFullOnBrdfs) {
    const int side = 10, n = side * side;
    for (const char* model :
         {"lambert", "phong n=10", "phong variant=classic n=5", "ward alpha_u=0.3 alpha_v=0.5",
          "ggx alpha=0.3", "oren_nayar sigma=0.6", "cook_torrance m=0.3"}) {
        const Numbers m = brdf_matrix(model, side);
        const Svd part = partial_svd(m, n, 16), full = full_svd(m, n);
        for (int j = 0; j < 16; ++j)
            EXPECT_NEAR(part.sigma[j], full.sigma[j], 1e-9 * full.sigma[0]) << model << " " << j;
    }
}

// Lambert's matrix is kd/pi everywhere: one singular value, kd/pi N.
TEST(PartialSvd, LambertHasOne) {
    const Svd svd = partial_svd(brdf_matrix("lambert reflectance=0.6", 8), 64, 3);
    EXPECT_NEAR(svd.sigma[0], 0.6 / 3.14159265358979 * 64., 1e-6);
    EXPECT_NEAR(svd.sigma[1], 0., 1e-9);
}

}  // namespace nacre
