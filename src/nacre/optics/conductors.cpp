#include "nacre/catalogue/catalogue.h"
#include "nacre/optics/dispersion.h"

namespace nacre {

namespace {

// One measured point: wavelength in nm, n, k.
struct Point {
    float nm, n, k;
};

// Silver. Johnson and Christy 1972, Optical constants of the noble metals, Phys. Rev. B 6.
constexpr Point silver[] = {
    {354.2f, 0.1f, 1.419f},  {367.9f, 0.07f, 1.657f}, {381.5f, 0.05f, 1.864f},
    {397.4f, 0.05f, 2.07f},  {413.3f, 0.05f, 2.275f}, {430.5f, 0.04f, 2.462f},
    {450.9f, 0.04f, 2.657f}, {471.4f, 0.05f, 2.869f}, {495.9f, 0.05f, 3.093f},
    {520.9f, 0.05f, 3.324f}, {548.6f, 0.06f, 3.586f}, {582.1f, 0.05f, 3.858f},
    {616.8f, 0.06f, 4.152f}, {659.5f, 0.05f, 4.483f}, {704.5f, 0.04f, 4.838f},
    {756.f, 0.03f, 5.242f},  {821.1f, 0.04f, 5.727f}, {892.f, 0.04f, 6.312f}};

// Aluminium. Rakic 1995, Algorithm for the determination of intrinsic optical constants of metal
// films, Appl. Opt. 34.
constexpr Point aluminium[] = {
    {326.28f, 0.31474f, 3.9165f}, {364.66f, 0.39877f, 4.3957f}, {413.28f, 0.52135f, 5.0008f},
    {442.8f, 0.6079f, 5.3676f},   {476.87f, 0.7278f, 5.7781f},  {516.6f, 0.8734f, 6.2418f},
    {563.57f, 1.0728f, 6.7839f},  {619.93f, 1.366f, 7.4052f},   {652.25f, 1.5724f, 7.7354f},
    {688.81f, 1.8301f, 8.0601f},  {729.32f, 2.1606f, 8.3565f},  {774.91f, 2.6154f, 8.4914f},
    {794.78f, 2.7675f, 8.3866f},  {815.69f, 2.7668f, 8.2573f},  {837.74f, 2.6945f, 8.1878f}};

// Gold. Johnson and Christy 1972.
constexpr Point gold[] = {{354.2f, 1.5f, 1.866f},  {367.9f, 1.48f, 1.895f}, {381.5f, 1.46f, 1.933f},
                          {397.4f, 1.47f, 1.952f}, {413.3f, 1.46f, 1.958f}, {430.5f, 1.45f, 1.948f},
                          {450.9f, 1.38f, 1.914f}, {471.4f, 1.31f, 1.849f}, {495.9f, 1.04f, 1.833f},
                          {520.9f, 0.62f, 2.081f}, {548.6f, 0.43f, 2.455f}, {582.1f, 0.29f, 2.863f},
                          {616.8f, 0.21f, 3.272f}, {659.5f, 0.14f, 3.697f}, {704.5f, 0.13f, 4.103f},
                          {756.f, 0.14f, 4.542f},  {821.1f, 0.16f, 5.083f}, {892.f, 0.17f, 5.663f}};

// Chromium. Johnson and Christy 1974, Optical constants of transition metals, Phys. Rev. B 9.
constexpr Point chromium[] = {{354.f, 1.84f, 2.64f}, {368.f, 1.87f, 2.69f}, {381.f, 1.92f, 2.74f},
                              {397.f, 2.f, 2.83f},   {413.f, 2.08f, 2.93f}, {431.f, 2.19f, 3.04f},
                              {451.f, 2.33f, 3.14f}, {471.f, 2.51f, 3.24f}, {496.f, 2.75f, 3.3f},
                              {521.f, 2.94f, 3.33f}, {549.f, 3.18f, 3.33f}, {582.f, 3.22f, 3.3f},
                              {617.f, 3.17f, 3.3f},  {659.f, 3.09f, 3.34f}, {704.f, 3.05f, 3.39f},
                              {756.f, 3.08f, 3.42f}, {821.f, 3.2f, 3.48f},  {892.f, 3.3f, 3.52f}};

// Copper. Johnson and Christy 1972.
constexpr Point copper[] = {
    {354.2f, 1.37f, 1.916f}, {367.9f, 1.36f, 1.975f}, {381.5f, 1.33f, 2.045f},
    {397.4f, 1.32f, 2.116f}, {413.3f, 1.28f, 2.207f}, {430.5f, 1.25f, 2.305f},
    {450.9f, 1.24f, 2.397f}, {471.4f, 1.25f, 2.483f}, {495.9f, 1.22f, 2.564f},
    {520.9f, 1.18f, 2.608f}, {548.6f, 1.02f, 2.577f}, {582.1f, 0.7f, 2.704f},
    {616.8f, 0.3f, 3.205f},  {659.5f, 0.22f, 3.747f}, {704.5f, 0.21f, 4.205f},
    {756.f, 0.24f, 4.665f},  {821.1f, 0.26f, 5.18f},  {892.f, 0.3f, 5.768f}};

// Iron. Johnson and Christy 1974.
constexpr Point iron[] = {{354.f, 1.93f, 2.35f}, {368.f, 2.02f, 2.43f}, {381.f, 2.12f, 2.5f},
                          {397.f, 2.24f, 2.58f}, {413.f, 2.35f, 2.65f}, {431.f, 2.48f, 2.71f},
                          {451.f, 2.59f, 2.77f}, {471.f, 2.67f, 2.82f}, {496.f, 2.74f, 2.88f},
                          {521.f, 2.86f, 2.91f}, {549.f, 2.95f, 2.93f}, {582.f, 2.94f, 2.99f},
                          {617.f, 2.88f, 3.05f}, {659.f, 2.92f, 3.1f},  {704.f, 2.86f, 3.19f},
                          {756.f, 2.87f, 3.28f}, {821.f, 2.94f, 3.39f}, {892.f, 2.96f, 3.56f}};

// Mercury. Inagaki, Arakawa, Williams 1981, Optical properties of liquid mercury, Phys. Rev. B 23.
constexpr Point mercury[] = {
    {344.4f, 0.64425f, 2.85991f}, {364.66f, 0.71303f, 3.0735f}, {387.45f, 0.79824f, 3.29351f},
    {413.28f, 0.898f, 3.53785f},  {442.8f, 1.02698f, 3.80193f}, {476.86f, 1.186f, 4.08981f},
    {516.6f, 1.38332f, 4.40608f}, {563.56f, 1.62088f, 4.7505f}, {619.92f, 1.90988f, 5.14953f},
    {688.8f, 2.28417f, 5.58189f}, {774.9f, 2.74611f, 6.05402f}, {885.6f, 3.3238f, 6.55726f}};

// Nickel. Johnson and Christy 1974.
constexpr Point nickel[] = {{354.f, 1.74f, 2.32f}, {368.f, 1.7f, 2.4f},   {381.f, 1.72f, 2.48f},
                            {397.f, 1.72f, 2.57f}, {413.f, 1.7f, 2.69f},  {431.f, 1.71f, 2.82f},
                            {451.f, 1.73f, 2.95f}, {471.f, 1.78f, 3.09f}, {496.f, 1.82f, 3.25f},
                            {521.f, 1.85f, 3.42f}, {549.f, 1.92f, 3.61f}, {582.f, 1.96f, 3.8f},
                            {617.f, 1.99f, 4.02f}, {659.f, 1.99f, 4.26f}, {704.f, 2.06f, 4.5f},
                            {756.f, 2.13f, 4.73f}, {821.f, 2.26f, 4.97f}, {892.f, 2.4f, 5.23f}};

struct Metal {
    std::string_view name;
    std::span<const Point> points;  ///< empty: a perfect mirror
};
constexpr Metal listed[] = {{"Ag", silver},   {"Al", aluminium}, {"Au", gold},
                            {"Cr", chromium}, {"Cu", copper},    {"Fe", iron},
                            {"Hg", mercury},  {"Ni", nickel},    {"none", {}}};

const Catalogue<Metal>& metals() {
    static const Catalogue<Metal> all("conductor", listed);
    return all;
}

}  // namespace

std::vector<std::string_view> conductor_names() { return metals().names(); }

ConductorIndex conductor_index(std::string_view name) {
    const Metal& metal = metals().find(name);
    if (metal.points.empty()) return {nullptr, nullptr, true};
    std::vector<float> nm, n, k;
    for (const Point& p : metal.points) {
        nm.push_back(p.nm);
        n.push_back(p.n);
        k.push_back(p.k);
    }
    return {make_tabulated(nm, n, SpectrumRole::unbounded),
            make_tabulated(nm, k, SpectrumRole::unbounded), false};
}

}  // namespace nacre
