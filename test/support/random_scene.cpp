#include "support/random_scene.h"

#include <algorithm>
#include <cmath>

namespace live_stiffness {
namespace {

double logUniform(RandomSource& random, double low, double high) {
  return low * std::exp(random.uniform(0.0, std::log(high / low)));
}

bool chance(RandomSource& random, double probability) { return random.uniform(0.0, 1.0) < probability; }

// Radii in proportion, so that chambers always fit between lumen and skin, and do not touch one another.
CrossSection randomSection(RandomSource& random, double radius, double modulus) {
  CrossSection section;
  section.outer_radius = radius;
  section.lumen_radius = radius * random.uniform(0.0, 0.35);
  section.chambers.radius = radius * random.uniform(0.1, 0.2);
  section.chambers.pitch_radius = radius * random.uniform(0.58, 0.72);
  constexpr int kCounts[] = {3, 4, 6};
  const int count = kCounts[static_cast<int>(random.uniform(0.0, 2.999))];
  const double turn = random.uniform(0.0, 2.0 * kPi);
  for (int k = 0; k < count; ++k) section.chambers.azimuths.push_back(turn + 2.0 * kPi * k / count);
  section.youngs_modulus = modulus;
  section.shear_modulus = modulus / (2.0 * (1.0 + random.uniform(0.3, 0.5)));
  section.shear_correction = random.uniform(0.8, 1.25);
  section.density = random.uniform(900.0, 1300.0);
  return section;
}

}  // namespace

RandomScene randomScene(RandomSource& random, const RandomSceneLimits& limits) {
  RandomScene result;
  Scene& scene = result.scene;
  const double radius = logUniform(random, 2e-3, 5e-2);
  const double modulus = logUniform(random, 3e3, 3e7);
  const int segments = 1 + static_cast<int>(random.uniform(0.0, limits.segments - 1e-6));
  for (int k = 0; k < segments; ++k) {
    Segment segment;
    const double thickness = radius * random.uniform(0.8, 1.2);
    segment.length = thickness * random.uniform(1.5, 12.0);
    segment.section = randomSection(random, thickness, modulus * random.uniform(0.7, 1.4));
    scene.chain.push_back(segment);
    if (chance(random, 0.5)) scene.chain.emplace_back(Link{segment.length * random.uniform(0.0, 0.4),
                                                        segment.mass() * random.uniform(0.0, 0.5)});
  }
  const double length = scene.length();
  double mass = 0.0;
  for (const Body& body : scene.chain)
    mass += std::holds_alternative<Segment>(body) ? std::get<Segment>(body).mass() : std::get<Link>(body).mass;
  if (chance(random, 0.6)) scene.tip_mass = mass * random.uniform(0.0, 0.4);
  mass += scene.tip_mass;
  if (chance(random, 0.6)) scene.tip_offset = random.vector(0.15 * length);

  const double bending_stiffness = modulus * kPi / 4.0 * std::pow(radius, 4);  // N m^2, about
  const double force_unit = bending_stiffness / (length * length);
  const double gravity = std::min(random.uniform(0.0, limits.weight) * force_unit / mass, 20.0 * kStandardGravity);
  if (chance(random, 0.85)) scene.gravity = random.direction(gravity);
  if (chance(random, 0.6))
    result.tip_wrench = random.wrench(limits.force * force_unit, limits.moment * force_unit * length);

  result.pressures.resize(scene.chamberCount());
  for (double& pressure : result.pressures)
    pressure = chance(random, 0.25) ? 0.0 : std::max(modulus * random.uniform(-0.2, 1.2), -kAtmospherePa);
  return result;
}

}  // namespace live_stiffness
