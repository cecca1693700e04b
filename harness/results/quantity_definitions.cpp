#include "harness/results/quantity_definitions.h"

#include <algorithm>
#include <sstream>

namespace trammel::results {

namespace {

/// Analyses in brackets ([+ ...]: these too), then a line for each quantity that all of them give;
/// after "+peak_" each also as its peak.
constexpr const char* kTable = R"(
[properties kinematics statics modes buckling large-statics]
[+ inverse-dynamics forward-dynamics elastodynamics grnn]
time_s  time of each point of the trajectory
pose_x_m  x of the platform's point P on the trajectory
pose_y_m  y of the platform's point P on the trajectory
pose_phi_rad  orientation of the platform on the trajectory
[transient large-motion]
time_s  time of each sample
[properties]
mass_kg:PART  mass
inertia_kg_m2:PART  moment of inertia about the part's own centre of mass
length_m:MEMBER  distance between the ends of a member
center_x_m:total  x of the centre of mass of the model
center_y_m:total  y of the centre of mass of the model
[kinematics inverse-dynamics]
active_angle_rad:JOINT  angle of an active joint
passive_angle_rad:JOINT  angle of a distal link
[kinematics]
elbow_sine:JOINT  sine of the angle between the links of a limb, 0 at a serial singularity
holding_torque_N_m:JOINT  torque of an active joint that balances the loads
distal_tension_N:LINK  tension of a distal link under the loads
closure_error_m  largest distance that a limb misses its platform joint by
parallel_singularity_distance  0 at a parallel singularity
serial_singularity_distance  0 at a serial singularity
[statics large-statics elastodynamics]
displacement_x_m:NODE  displacement along x
displacement_y_m:NODE  displacement along y
rotation_rad:NODE  rotation, counterclockwise
end_rotation_rad:MEMBER.END  rotation of a member's start or end
axial_force_N:MEMBER.END  axial force, tension positive
shear_force_N:MEMBER.END  shear force V = -dM/dx, x from the first node to the second
bending_moment_N_m:MEMBER.END  bending moment, positive where the right side on the way to the second node is stretched
reaction_x_N:SUPPORT  reaction of the ground along x
reaction_y_N:SUPPORT  reaction of the ground along y
reaction_moment_N_m:SUPPORT  reaction moment of the ground, counterclockwise
[statics elastodynamics]
stress_Pa:MEMBER  largest stress by axial force and bending along a member
von_mises_stress_Pa:PLATE  largest von Mises stress of a plate
equilibrium_residual_N  force that loads and reactions lack for equilibrium of the whole model, inside a step by the error of interpolation; of its parts see the residual recovered_forces
moment_residual_N_m  moment that loads and reactions lack about the world origin; springs between nodes that lie apart leave their couple
[statics]
bending_stress_Pa:MEMBER.END  bending moment over section modulus
stress_xx_Pa:NODE  normal stress along x at a node of a plate
stress_yy_Pa:NODE  normal stress along y at a node of a plate
stress_xy_Pa:NODE  shear stress at a node of a plate
[statics]
compliance_J  work of the loads on the displacements
estimated_correct_digits  decimal digits of the displacements that round-off and the last iteration leave
[buckling]
load_factor:MODE  factor on all loads at which the model buckles
critical_force_N:LOAD  size of a force at the load factor
[modes buckling transient harmonic]
degrees_of_freedom  free coordinates of the model
[large-statics]
load_factor  factor on all loads at each point of the path
limit_load_factor  load factor of a limit point
bifurcation_load_factor  load factor of a bifurcation
unstable_directions  negative eigenvalues of the tangent stiffness
newton_iteration  number of an iteration at the last point
newton_correction  size of its correction
newton_residual_N_m  size of the forces out of balance before it
[large-statics large-motion]
newton_iterations  Newton iterations at each point, or of the whole motion
drive_torque_N_m:DRIVE  torque of a drive
drive_force_N:DRIVE  force of a drive
[modes large-statics]
frequency_Hz:MODE  natural frequency; with the mode along a trajectory, over speeds or load factors
growth_rate_per_s:MODE  real part of the eigenvalue
[modes]
frequency_roundoff:MODE  estimate of its relative round-off error
frequency_gap:MODE  relative distance from the frequency below
tracked_frequency_Hz:MODE  frequency of the mode that continues this one of the first point, by shape
shape_assurance:MODE  how much that mode's shape resembles the one a point before (1: the same)
mode_count_below  modes below count_below_Hz, by a Sturm count
rigid_body_modes  modes without strain energy
uncondensed_poses  poses of the path that condensed links could not certify, and that were solved in full
angular_speed_rad_s  angular speed of the rotating frame
stable  1 where no mode grows
steady_displacement_x_m:NODE  displacement along x in steady rotation
steady_displacement_y_m:NODE  displacement along y in steady rotation
[transient harmonic +peak_]
displacement_x_m:NODE  displacement along x, or its amplitude
displacement_y_m:NODE  displacement along y, or its amplitude
rotation_rad:NODE  rotation, or its amplitude
velocity_x_m_per_s:NODE  velocity along x, or its amplitude
velocity_y_m_per_s:NODE  velocity along y, or its amplitude
angular_velocity_rad_per_s:NODE  angular velocity, or its amplitude
acceleration_x_m_per_s2:NODE  acceleration along x, or its amplitude
acceleration_y_m_per_s2:NODE  acceleration along y, or its amplitude
axial_force_N:MEMBER.END  axial force, or its amplitude
shear_force_N:MEMBER.END  shear force, or its amplitude
bending_moment_N_m:MEMBER.END  bending moment, or its amplitude
bending_stress_Pa:MEMBER.END  bending stress, or its amplitude
stress_Pa:MEMBER  largest stress along a member, or its amplitude
[transient]
peak_time_s:OUTPUT  time of the largest magnitude of an output
[harmonic]
frequency_Hz  frequency of the excitation
natural_frequency_Hz  natural frequencies, where modes are superposed
peak_frequency_Hz:OUTPUT  frequency of the largest amplitude of an output, or of the resonance that nothing bounds
[transient large-motion elastodynamics inverse-dynamics forward-dynamics]
kinetic_energy_J  kinetic energy
[transient large-motion elastodynamics]
strain_energy_J  strain energy
energy_drift  change of the energy over the largest energy
[transient large-motion]
total_energy_J  kinetic energy and potential energy
[large-motion]
rotation_rad:NODE  rotation
velocity_x_m_per_s:NODE  velocity along x
velocity_y_m_per_s:NODE  velocity along y
angular_velocity_rad_per_s:NODE  angular velocity
position_x_m:NODE  x of a node
position_y_m:NODE  y of a node
relative_x_m:NODE  displacement along x seen from the node relative_to
relative_y_m:NODE  displacement along y seen from the node relative_to
relative_rotation_rad:NODE  rotation seen from the node relative_to
angle_rad:ANGLE  angle that the case asks for
angle_rate_rad_per_s:ANGLE  its rate
reaction_x_N:SUPPORT  reaction along x
reaction_y_N:SUPPORT  reaction along y
reaction_N:SUPPORT  size of the reaction
reaction_moment_N_m:SUPPORT  reaction moment
pose_x_m  x of P on the trajectory that is tracked
pose_y_m  y of P on the trajectory that is tracked
deflection_x_m:P  deflection of P from the trajectory along x
deflection_y_m:P  deflection of P from the trajectory along y
deflection_m:P  size of the deflection of P from the trajectory
constraint_residual  largest violation of a constraint
constraint_rate_residual  largest violation of a constraint's rate
[transient large-motion elastodynamics forward-dynamics]
steps  accepted steps
[large-motion elastodynamics forward-dynamics]
rejected_steps  rejected steps
[large-motion elastodynamics]
smallest_step_s  smallest step
[large-motion elastodynamics inverse-dynamics]
torque_N_m:JOINT  torque of an active joint
[elastodynamics]
largest_step_s  largest step
step_residual  largest residual of a step's equations
deflection_m:P  size of the deflection of P from the trajectory
platform_rotation_rad  rotation of the platform from the trajectory
tangential_error_m:P  deflection of P along the trajectory
normal_error_m:P  deflection of P across the trajectory
rigid_torque_N_m:JOINT  torque of an active joint with rigid links
elastic_torque_N_m:JOINT  difference that flexibility makes to the torque
load_work_J  work of the loads on the free coordinates, which where inextensible links move depend on the axes
dissipated_energy_J  energy lost by damping, on the free coordinates as the work of the loads
dynamic_to_quasi_static_difference:P  distance from the quasi-static P over its largest deflection
integration_error:P  difference from modal superposition over the largest deflection
step_change:P  difference that half the step makes over the largest deflection
overdamped_above_Hz  frequency above which modes do not vibrate
mode_count_below  modes below that frequency
first_frequency_Hz  first natural frequency at the start
damping_ratio  damping ratio of the first mode
nominal_inertia_number  (rate of the nominal motion over the first frequency)^2
elastic_inertia_number  (rate of the path over the first frequency)^2
transformation_rate_number  twice the fastest turning over the first frequency
effect_number:EFFECT  dimensionless number that an effect's worth is estimated by
effect_change:EFFECT  at most what the results change without an effect and those before it
[inverse-dynamics]
active_velocity_rad_per_s:JOINT  angular velocity of an active joint
active_acceleration_rad_per_s2:JOINT  angular acceleration of an active joint
passive_velocity_rad_per_s:JOINT  angular velocity of a distal link
passive_acceleration_rad_per_s2:JOINT  angular acceleration of a distal link
center_x_m:BODY  x of a body's centre of mass
center_y_m:BODY  y of a body's centre of mass
center_velocity_x_m_per_s:BODY  its velocity along x
center_velocity_y_m_per_s:BODY  its velocity along y
center_acceleration_x_m_per_s2:BODY  its acceleration along x
center_acceleration_y_m_per_s2:BODY  its acceleration along y
kinetic_power_W  rate of the kinetic energy
actuator_power_W  power of the active joints
load_power_W  power of the loads
gravity_power_W  power of the weights
power_residual  what the powers lack of balance, relative
symmetry_residual  asymmetry of the inertia matrix, relative
skewness_residual  how far (dM/dt - 2 C) is from skew symmetry, relative
min_inertia_eigenvalue_kg_m2  smallest eigenvalue of the inertia matrix
cycle_work_J  work of the active joints over one turn
cycle_absolute_work_J  integral of the size of their power over one turn
cycle_work_residual  the first over the second
[forward-dynamics]
motion_x_m  x of P
motion_y_m  y of P
motion_phi_rad  orientation of the platform
motion_velocity_x_m_per_s  velocity of P along x
motion_velocity_y_m_per_s  velocity of P along y
motion_velocity_phi_rad_per_s  angular velocity of the platform
position_error_m  distance of P from the trajectory
orientation_error_rad  difference of orientation from the trajectory
velocity_error_m_per_s  difference of the velocity of P from the trajectory
energy_residual  kinetic energy less the work done, over the largest kinetic energy
evaluations  evaluations of the equations of motion
[sensitivity sensitivity-map]
frequency_Hz:MAP  natural frequency, at each position of a map
sensitivity_Hz_per_m:PARAMETER  derivative of the frequency with a length
[sensitivity]
sensitivity_Hz_per_Pa:PARAMETER  derivative of the frequency with Young's modulus
sensitivity_Hz_m3_per_kg:PARAMETER  derivative of the frequency with a density
sensitivity_Hz_per_kg:PARAMETER  derivative of the frequency with a mass
sensitivity_Hz_per_kg_m2:PARAMETER  derivative of the frequency with a moment of inertia
sensitivity_Hz_rad_per_N_m:PARAMETER  derivative of the frequency with a joint's stiffness
sensitivity_Hz_per_rad:PARAMETER  derivative of the frequency with the orientation
sensitivity_Hz:PARAMETER  derivative of the frequency with Poisson's ratio
relative_sensitivity:PARAMETER  derivative times parameter over frequency
finite_difference_error:PARAMETER  error of a difference quotient, relative
frequency_gap  relative distance from the nearest frequency
multiplicity  how often a frequency is repeated
[sensitivity-map]
position_x_m:MAP  x of each position of P
position_y_m:MAP  y of each position of P
boundary_x_m:MAP  x along the boundary of the workspace
boundary_y_m:MAP  y along the boundary of the workspace
singular_x_m:MAP  x along the parallel singularities
singular_y_m:MAP  y along the parallel singularities
center_frequency_Hz  frequency at the centre, for each orientation
mean_frequency_Hz  mean frequency of the map, for each orientation
center_sensitivity_Hz_per_m  sensitivity at the centre, for each orientation
mean_sensitivity_Hz_per_m  mean sensitivity of the map, for each orientation
largest_sensitivity_Hz_per_m  largest sensitivity of the map, for each orientation
sensitivity_rise_percent:READING  rise of a sensitivity from the first orientation
frequency_rise_percent:READING  rise of a frequency from the first orientation
[grnn]
cross_validation_error  error of cross-validation at the sigma chosen
sigma_bracketed  1 where the least error lies inside the grid of sigmas
sigmas_tried  sigmas that were tried
grid_sigma  sigmas of the grid
grid_error  error of cross-validation of each
sigma  width of the kernel
kernel_evaluations  kernels of one prediction
prediction:OUTPUT  predicted outputs of the queries
active_angle_rad:JOINT  angle of an active joint
active_velocity_rad_per_s:JOINT  angular velocity of an active joint
predicted_angle_rad:JOINT  its prediction
predicted_velocity_rad_per_s:JOINT  its prediction
predicted_position_x_m:P  x of P at the predicted angles
predicted_position_y_m:P  y of P at the predicted angles
in_training_set  1 for the points that train
training_angle_error_rad:JOINT  error of the angles that train
training_velocity_error_rad_per_s:JOINT  error of the velocities that train
training_rms_error  root mean square of those errors, over standard deviations
training_largest_error_of_range  largest of those errors, over the range of its output
held_out_angle_error_rad:JOINT  error of the angles held out
held_out_velocity_error_rad_per_s:JOINT  error of the velocities held out
held_out_rms_error:PREDICTOR  root mean square of those errors, or of a trivial predictor
held_out_largest_error_of_range  largest of those errors, over the range of its output
skill_score_against:PREDICTOR  1 - (rms error over that of a trivial predictor)^2
[manufactured]
displacement_error  relative error norm of the displacements
rotation_error  relative error norm of the rotations
stress_error  relative error norm of the stresses
energy_error  relative error in the energy norm
axial_displacement_error  relative error norm of the axial displacement
axial_force_error  relative error norm of the axial force
deflection_error  relative error norm of the deflection
bending_moment_error  relative error norm of the bending moment
shear_force_error  relative error norm of the shear force
nodal_deflection_error  relative error norm of the deflection at nodes
nodal_rotation_error  relative error norm of the rotation at nodes
[comparison]
relative_difference:PAIR  difference of two references over the second
difference_percent:PAIR  the same in percent
[model-probabilities]
reading_count  readings that have modes, stored ones included
excluded_reading_count  combinations that have no meaning
log_evidence:ROW  natural logarithm of the row's marginal likelihood over all readings, at each discrepancy
class_count:ROW  readings that the row could tell apart
class_entropy_bits:ROW  entropy of the classes' probabilities [bit]
credible_class_count:ROW  classes that hold 95 % of the probability
largest_class_probability:ROW  of the most probable class
expected_information_bits:ROW  by the further number that is expected to tell most [bit]
[study]
parameter  the parameter of the study, under the name that the study gives it
status  0 solved, 1 singular, 2 not converged, at each value of the parameter
relative_error:QUANTITY  forward error of a quantity, relative
roundoff:QUANTITY  round-off error that the solver promised, relative
error_over_roundoff:QUANTITY  forward error over that promise
min_error_at:QUANTITY  parameter of the least error
[options]
attempted:CASE  combinations of options
solved:CASE  of these, solved
singular:CASE  of these, singular
not_converged:CASE  of these, not converged
refused:CASE  of these, refused in words
not_finite:CASE  of these, solved with a number that is none
unexplained:CASE  of these, not solved and without a reason
result_difference_over_roundoff:CASE  largest change by an option, over round-off
)";

std::vector<QuantityDefinition> read_table() {
  std::vector<QuantityDefinition> all;
  std::vector<std::string> analyses;
  std::string prefix;
  std::istringstream table(kTable);
  for (std::string line; std::getline(table, line);) {
    if (line.empty()) continue;
    if (line.front() == '[') {
      std::istringstream names(line.substr(1, line.size() - 2));
      if (line[1] != '+') analyses.clear();
      prefix.clear();
      for (std::string name; names >> name;) {
        if (name.front() != '+') analyses.push_back(name);
        if (name.front() == '+') prefix = name.substr(1);
      }
      continue;
    }
    const std::size_t gap = line.find("  ");
    const std::string name = line.substr(0, gap), meaning = line.substr(gap + 2);
    all.push_back({name, analyses, meaning});
    if (!prefix.empty()) all.push_back({prefix + name, analyses, "largest magnitude: " + meaning});
  }
  return all;
}

}  // namespace

const std::vector<QuantityDefinition>& quantity_definitions() {
  static const std::vector<QuantityDefinition> all = read_table();
  return all;
}

bool QuantityDefinition::is_of(const std::string& analysis) const {
  return std::find(analyses.begin(), analyses.end(), analysis) != analyses.end();
}

const QuantityDefinition* find_quantity_definition(const std::string& name,
                                                   const std::string& analysis) {
  const std::string head = name.substr(0, name.find(':'));
  for (const QuantityDefinition& one : quantity_definitions())
    if (one.head() == head && (analysis.empty() || one.is_of(analysis))) return &one;
  return nullptr;
}

}  // namespace trammel::results
