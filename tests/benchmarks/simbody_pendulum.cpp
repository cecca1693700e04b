// Pendulum of peers.py in Simbody 3.7: a steel strip with a bob at its end, released in the
// horizontal position. The strip is modeled by rigid rods and torsion springs of stiffness EI /
// (rod length). The discretization error is of order 2 in the rod length. The Runge-Kutta-Merson
// method was the fastest of Simbody's integrators.
//   simbody_pendulum RODS ACCURACY    x and y of the bob at 0, 0.05, ..., 1 s [m]
#include <Simbody.h>

#include <cstdio>
#include <cstdlib>

int main(int count, char** words) {
  using namespace SimTK;
  if (count != 3) return 2;
  const int rods = std::atoi(words[1]);
  const double EI = 2e11 * 0.02 * 8e-9 / 12, length = 1.0 / rods, mass = 7870 * 4e-5 * length;
  MultibodySystem system;
  SimbodyMatterSubsystem matter(system);
  GeneralForceSubsystem forces(system);
  Force::UniformGravity(forces, matter, Vec3(0, -9.81, 0));
  const Vec3 middle(length / 2, 0, 0), end(length, 0, 0);
  const double inertia = mass * length * length / 12;
  const Body::Rigid rod(
      MassProperties(mass, middle, Inertia(0, inertia, inertia).shiftFromMassCenter(middle, mass)));
  MobilizedBody last = matter.Ground();
  for (int i = 0; i < rods; ++i) {
    const MobilizedBody::Pin next(last, i == 0 ? Vec3(0) : end, rod, Vec3(0));
    if (i > 0) Force::MobilityLinearSpring(forces, next, 0, EI / length, 0);
    last = next;
  }
  const Body::Rigid bob(MassProperties(1, Vec3(0), Inertia(0)));
  last = MobilizedBody::Weld(last, end, bob, Vec3(0));
  RungeKuttaMersonIntegrator integrator(system);
  integrator.setAccuracy(std::atof(words[2]));
  integrator.initialize(system.realizeTopology());
  for (int k = 0; k <= 20; ++k) {
    while (integrator.getTime() < 0.05 * k) integrator.stepTo(0.05 * k);
    const Vec3 at = last.getBodyOriginLocation(integrator.getState());
    std::printf("%.12g %.12g\n", at[0], at[1]);
  }
  return 0;
}
