!> Lists the tolerances of the program: the value, what it is relative to, and why it has this size.
!! Arithmetic has 16 digits. A number from one operation is right to 1E-16, a sum or a small factorisation to 1E-14 to 1E-12,
!! a coordinate of ten digits to 1E-9, a place that a mesh generator has computed to 1E-6. What users may set stands here as its
!! default.
!! In other modules stay the ranges of fields (`least_power`, `smallest_size`) and the usual sizes of materials (`unit_watch`).
module tolerances
   use kinds, only: wp
   implicit none
   public

   ! ---- sums, components and factorisations: what is rounding
   real(wp), parameter :: rounding_of_sums = 1.0e-14_wp !! of the sum of the absolute values of its terms: some 100 roundings
   real(wp), parameter :: rounding_of_forces = 10.0_wp*epsilon(1.0_wp) !! of stiffness times displacement, of a sum of works
   real(wp), parameter :: rounding_of_entries = 16.0_wp*epsilon(1.0_wp) !! of the largest entry of a matrix after a few products
   real(wp), parameter :: most_rounding_of_forces = 1.0e-6_wp !! of the load: joints cannot balance forces that are less precise
   real(wp), parameter :: zero_component = 1.0e-12_wp !! of the length of a vector as the deck gives it
   real(wp), parameter :: zero_component_along = 1.0e-10_wp !! of the length of a vector, along axes that are computed
   real(wp), parameter :: zero_cosine = 1.0e-9_wp    !! of unit vectors from coordinates: they are perpendicular
   real(wp), parameter :: zero_resultant = 1.0e-12_wp !! of the load: the resultant of forces that cancel
   real(wp), parameter :: zero_pivot_of_equations = 1.0e-10_wp !! of the largest entry: coefficients of MPC have few digits
   real(wp), parameter :: zero_pivot_of_fit = 1.0e-12_wp !! of the largest entry: squares of arms of nodes of an RBE3
   real(wp), parameter :: determined_motion = 1.0e-8_wp !! of a unit motion: what the fit of an RBE3 leaves, the root of 1E-16
   real(wp), parameter :: released_pivot = 1.0e-12_wp !! of the stiffness before releases: an earlier release has left none
   real(wp), parameter :: zero_rotation_stiffness = 1.0e-9_wp !! of the largest at the node: rods that are parallel but for rounding
   real(wp), parameter :: idle_stiffness = 1.0e-8_wp !! of the largest at the node, as NASTRAN's EPZERO; of the load on it
   real(wp), parameter :: dependent_columns = 1.0e-12_wp !! reciprocal condition number of scaled columns: a least-squares fit fails
   real(wp), parameter :: indefinite_inertia = 1.0e-12_wp !! of a scaled tensor: a principal minor that is negative by rounding
   real(wp), parameter :: symmetric_tie = 1.0e-6_wp  !! of a value: equal ones of a symmetric structure, above its solution error

   ! ---- directions and planes
   real(wp), parameter :: same_direction = 1.0e-9_wp !! 1 - cosine: directions that the deck gives as one
   real(wp), parameter :: one_direction = 1.0e-8_wp  !! 1 - cosine: normals of planes of symmetry from supports, angle 1.4E-4
   real(wp), parameter :: parallel_axes = 1.0e-10_wp !! sine: z of a coordinate system and its third point give no plane
   real(wp), parameter :: along_the_beam = 1.0e-6_wp !! sine: an orientation vector along its beam gives no axis
   real(wp), parameter :: parallel_in_mesh = 1.0e-3_wp !! sine: planes, bolts, supports of a mesh with three or more good digits
   real(wp), parameter :: edgewise_face = 1.0e-6_wp  !! sine: a face seen along itself covers no area
   real(wp), parameter :: level_tangent = 1.0e-6_wp  !! angle [rad] of a tangent, share of an edge: its edge counts as straight
   real(wp), parameter :: plane_shell = 1.0e-4_wp    !! of the size of a shell of eight nodes: they lie in a plane, by the digits of a mesh
   real(wp), parameter :: closed_joint = 1.0e-6_wp   !! of the area: the sum of normals of a joint that faces all ways
   real(wp), parameter :: balanced = 1.0e-6_wp       !! of the sum of forces: a load with this resultant is self-equilibrated

   ! ---- places
   real(wp), parameter :: zero_coordinate = 1.0e-12_wp !! of the distance of points and systems: a point on an axis
   real(wp), parameter :: on_axis = 1.0e-9_wp        !! of the distance from the origin: r and theta have no directions
   real(wp), parameter :: no_coupling = 1.0e-9_wp    !! of the largest term of a MAT9: its axes are those of the model
   real(wp), parameter :: part_distance = 1.0e-5_wp  !! as given: nodes of two superelements at one place, NASTRAN's default of TOL
   real(wp), parameter :: equal_distance = 1.0e-9_wp !! of the extent of the model: nodes at one distance from a given place
   real(wp), parameter :: same_gap_point = 1.0e-9_wp !! of the extent of a gap table: its points coincide
   real(wp), parameter :: flat_shell = 1.0e-6_wp     !! angle between its parts, and with the axis of a component: one plane [rad]
   real(wp), parameter :: flat_height = 1.0e-13_wp   !! of the square of that extent: four points on a circle
   real(wp), parameter :: off_square = 1.0e-4_wp     !! of the height of the paraboloid: four points nearer to a circle count as a square
   real(wp), parameter :: same_corner = 1.0e-9_wp    !! of the longest edge: corners of an element in one place
   real(wp), parameter :: same_node = 1.0e-5_wp      !! of the shortest edge at a node: nodes that a mesh may have left unmerged
   real(wp), parameter :: welded_nodes = 1.0e-6_wp   !! of the size of a block: nodes of blocks that are welded
   real(wp), parameter :: on_symmetry_plane = 1.0e-5_wp !! of the extent of the model: a node on the plane, by six digits
   real(wp), parameter :: at_the_bottom = 1.0e-6_wp  !! of the extent: faces at the level of the lowest
   real(wp), parameter :: on_rim = 1.0e-6_wp         !! of the size of a side: a point on its rim
   real(wp), parameter :: past_the_end = 1.0e-9_wp   !! of the length of a beam: a load at its end, given as a length
   real(wp), parameter :: touching_faces = 1.0e-12_wp !! of the coordinates: a distance of faces that is their difference
   real(wp), parameter :: in_section = 1.0e-3_wp     !! of the size of a pretension section: nodes near its plane, as of a mesh
   real(wp), parameter :: beside_each_other = 1.0e-3_wp !! of the extent of the model: nodes of a CJOINT across its normal
   real(wp), parameter :: beside_bolt = 1.0e-3_wp    !! of the radius of a bolt: a node on its surface, as of a mesh
   real(wp), parameter :: no_lever = 1.0e-6_wp       !! of the arm of a rotation: a spring through its node
   real(wp), parameter :: pairing_reach = 1.0e-3_wp  !! of the shortest edge of SIDE1: default distance of the nodes of a pair
   real(wp), parameter :: most_aside = 1.0e-4_wp     !! of the shortest edge at a node: offset of its partner across the normal

   ! ---- elements, faces and their overlap
   real(wp), parameter :: degenerate = 1.0e-12_wp    !! of (longest edge)**dimension: det J, and of that edge: corners in one place
   real(wp), parameter :: still_point = 1.0e-14_wp   !! of local coordinates: the last step of Newton's method
   real(wp), parameter :: alternating_point = 1.0e-9_wp !! of local coordinates: the step of iterates that alternate by rounding
   real(wp), parameter :: zero_overlap = 1.0e-10_wp  !! of the area of the first face: a piece that no other result can show
   real(wp), parameter :: straight_corner = 1.0e-3_wp !! of zero_overlap: area of the triangle at a corner without a turn
   real(wp), parameter :: zero_area = 1.0e-12_wp     !! of the area of the faces beside it, of the largest area: a sum that cancels
   real(wp), parameter :: zero_weight = 1.0e-12_wp   !! of one: a weight of the mortar projection; its node is not connected
   real(wp), parameter :: no_inertia = 1.0e-9_wp     !! of the largest moment of inertia of a joint: no rotation about this axis

   ! ---- cards
   real(wp), parameter :: least_fraction = 1.0e-12_wp !! of the load of a stage: increments of less do nothing
   real(wp), parameter :: sum_of_shares = 1.0e-4_wp  !! of one: shares of a card with four digits are scaled to the sum 1
   real(wp), parameter :: equal_ends = 1.0e-6_wp     !! of the value at end A: a beam of one section, values of six digits
   real(wp), parameter :: same_frequency = 1.0e-9_wp !! of the largest frequency: two requests are one
   real(wp), parameter :: exactly_one = 1.0e-9_wp    !! of one: a gravity of 1, which a LOAD multiplies
   real(wp), parameter :: whole_power_of_ten = 1.0e-9_wp !! of a logarithm: a factor between units
   real(wp), parameter :: least_misfit = 1.0e-6_wp   !! strain by temperature: below it a warning is of no interest
   real(wp), parameter :: pressure_of_no_load = 1.0e-6_wp !! of the largest E: a guess of the pressure where the deck gives none

   ! ---- default and limit of TOL
   real(wp), parameter :: newton_tol = 1.0e-10_wp    !! of the largest load: unbalanced force by NEWTON, far below what is printed
   real(wp), parameter :: path_tol = 1.0e-3_wp       !! of the largest deflection and pressure: default of PATHTOL, three digits
   real(wp), parameter :: back_tol = 1.0e-6_wp       !! of pressures: change in an iteration of BACK, which converges linearly
   real(wp), parameter :: amplitude_tol = 1.0e-4_wp  !! of frequency and loss: default of JAMPL, four digits
   real(wp), parameter :: least_tol = 1.0e-14_wp     !! the least TOL: rounding allows no less
   real(wp), parameter :: far_below_tol = 1.0e-3_wp  !! of TOL: below it another iteration is not worth while
   real(wp), parameter :: loose_direction = 1.0e-2_wp !! of the residual: what a direction may leave where solutions are dear
   real(wp), parameter :: rough_direction = 0.1_wp   !! of it: the same where the next direction takes account of what is left
   real(wp), parameter :: tight_direction = 1.0e-4_wp !! of it: the same elsewhere
   real(wp), parameter :: finest_direction = 1.0e-12_wp !! of it: rounding allows no less
   real(wp), parameter :: krylov_residual = 1.0e-12_wp !! of the load: what the iterations of PETSC leave
   real(wp), parameter :: no_residual = 1.0e-300_wp  !! [force]: so small that only the relative limit acts
   real(wp), parameter :: loosest_residual = 1.0e-9_wp !! of the load: PETSC and MUMPS, where rounding allows no less

   ! ---- laws of the joints
   real(wp), parameter :: pressure_floor = 1.0e-6_wp !! of p_av: the least p of a loading element, whose stiffness is not zero
   real(wp), parameter :: rounding_of_a_change = 1.0e-10_wp !! of force, stress or movement of an element: no change, NEWTON's TOL
   real(wp), parameter :: rounding_of_deflections = 1.0e-12_wp !! of a deflection: a smaller movement, or change of pressure by it
   real(wp), parameter :: rounding_of_path = 1.0e-12_wp !! of the path of shear: no shorter piece is begun; of slopes: no difference
   real(wp), parameter :: touching_curve = 1.0e-11_wp !! of the stresses: a branch meets a curve; below the change by rounding
   real(wp), parameter :: slip_margin = 1.0e-9_wp    !! of the friction limit: rounding does not cause slip
   real(wp), parameter :: no_excess = 1.0e-12_wp     !! of the sum of all limits: excess that is rounding
   real(wp), parameter :: flag_margin = 1.0e-7_wp    !! of the limit: the remainder of a relief is no slip in the next increment
   real(wp), parameter :: rest_margin = -1.0e-6_wp   !! of the limit: settled secants are at the limit to which BACK cuts them
   real(wp), parameter :: settled_secant = 1.0e-4_wp !! of a secant of BACK: deflections are settled to less
   real(wp), parameter :: no_stress_direction = 1.0e-12_wp !! of the limit: a stress so small has no direction
   real(wp), parameter :: no_turn = 1.0e-8_wp        !! of the limit: a gain that turns no stress, its square is rounding
   real(wp), parameter :: equal_gaps = 1.0e-9_wp     !! of the range of the gaps: elements that close together
   real(wp), parameter :: equal_loop_gaps = 1.0e-9_wp !! of tau_r: gaps of loops that are equal; the first counts
   real(wp), parameter :: on_the_graph = 1.0e-6_wp   !! of the force: a point on the law; the next iteration corrects the rest
   real(wp), parameter :: least_rho = 1.0e-3_wp      !! of the first rho: a softer straight law gains nothing
   real(wp), parameter :: stand_in_stiffness = 1.0e-7_wp !! of the elastic stiffness: of an element that has none, to hold its body
   real(wp), parameter :: same_work = 1.0e-3_wp      !! of the work of the last trial: what falls less in a tenfold step does not fall
   real(wp), parameter :: near_by = 1.0e-3_wp        !! of the width of the largest joint: far more than elastic slip
   real(wp), parameter :: farther_off = 1.0e-2_wp    !! of it: a body that still moves on; the rest of the way is extrapolated
   real(wp), parameter :: seated = 1.0e-3_wp         !! of the first forces on the motions of parts: these have found their seats
   real(wp), parameter :: shortest_step = 1.0e-6_wp  !! of a direction that leads far away: the step is not shortened below it
   real(wp), parameter :: least_share = 1.0e-3_wp    !! of an increment: limits of friction that bear less of it are at their end
   real(wp), parameter :: least_start = 1.0e-4_wp    !! of an element's last pressure: nothing before it counts on a graded path
   real(wp), parameter :: on_the_path = 1.0e-4_wp    !! of the residual of the first guess: left at a state of the path, far below PATHTOL
   real(wp), parameter :: off_path = 0.01_wp         !! of the largest deflection, pressure, the area: an error of path to warn of
   real(wp), parameter :: equal_shares = 1.0e-6_wp   !! of a limit: the rounding of a sum of areas
   real(wp), parameter :: no_contact = 1.0e-6_wp     !! of the largest pressure: an element pressed by less may as well be open
   real(wp), parameter :: least_scale = 1.0e-9_wp    !! of the largest value so far: what a difference to the law is relative to
   real(wp), parameter :: slip_at_once = 1.0e-6_wp   !! of the way: slip that begins before it begins at once; error: its square
   real(wp), parameter :: end_of_way = 1.0e-9_wp     !! of the way: a zero at its end counts as the end
   real(wp), parameter :: zero_stress = 1.0e-13_wp   !! of the stresses: a difference of two of them
   real(wp), parameter :: least_slope = 1.0e-6_wp    !! of the first slope of a curve: at its peak delta takes no part of d D

   ! ---- solution of the equations
   real(wp), parameter :: pivot_tolerance = 1.0e-12_wp !! of the diagonal entry: rounding; the unknown has no stiffness
   real(wp), parameter :: step_tolerance = 1.0e-13_wp !! of the solution, energy norm: steps are as good as a factor
   real(wp), parameter :: sliding_stiffness = 1.0e-4_wp !! of the diagonal entry: its forces are small beside those of the joints
   real(wp), parameter :: dependent_product = 1.0e-10_wp !! of the product of [k] and a direction: rounding of products
   real(wp), parameter :: equal_errors = 1.0e-6_wp   !! of an eigenvalue: errors of a factor that are alike
   real(wp), parameter :: no_error = 1.0e-6_wp       !! square of the error of a factor in a direction: a step leaves nothing there
   real(wp), parameter :: dependent_energy = 1.0e-12_wp !! of the energy of a solution: the rest adds nothing to a guess
   real(wp), parameter :: rounding_of_directions = 1.0e-9_wp !! of the largest load: a direction that balances less is not kept

   ! ---- vibration
   real(wp), parameter :: lanczos_tolerance = 1.0e-13_wp !! of nu: the error estimate of Lanczos, near rounding
   real(wp), parameter :: settled_shape = 1.0e-10_wp !! of displacements: the last change by inverse iteration
   real(wp), parameter :: massless = 1.0e-12_wp      !! of the largest nu: a mode without significant mass
   real(wp), parameter :: wide_gap = 1.0e-6_wp       !! of an eigenvalue: a gap in which a shift counts safely
   real(wp), parameter :: off_the_pole = 1.0e-7_wp   !! of a shift: by which it moves away from an eigenvalue, times 10 a trial
   real(wp), parameter :: zero_eigenvalue = 2.0e-13_wp !! of the largest eigenvalue: rounding
   real(wp), parameter :: zero_at_shift = 1.0e-9_wp  !! of the shift: rounding of an eigenvalue from it
   real(wp), parameter :: rigid_motion = 1.0e-4_wp   !! of the next eigenvalue: far enough below it for a rigid-body motion
   real(wp), parameter :: barely_held = 1.0e-8_wp    !! of a diagonal entry: the smallest pivot of a structure that is held
   real(wp), parameter :: equal_eigenvalues = 1.0e-7_wp !! of the larger one: modes of a symmetric structure, in any mixture
   real(wp), parameter :: weak_participation = 1.0e-6_wp !! of the root of the mass: too small to separate equal modes
   real(wp), parameter :: undamped = 1.0e-12_wp      !! of the strain energy of a mode: that of its damped parts is rounding
   real(wp), parameter :: no_motion = 1.0e-10_wp     !! of the largest amplitude at a frequency: rounding, which has no phase
   real(wp), parameter :: unexcited = 1.0e-9_wp      !! of a mode: a load or component that does not excite or show it
   real(wp), parameter :: at_resonance = 1.0e-12_wp  !! of lambda: an undamped mode at its own frequency
   real(wp), parameter :: exact_tol = 1.0e-10_wp     !! the largest TOL on the path of a mode
   real(wp), parameter :: finest_tol = 1.0e-13_wp    !! of the held load: the least TOL there
   real(wp), parameter :: finest_step = 1.0e-7_wp    !! of alpha: a smaller step is not halved
   real(wp), parameter :: closing_step = 1.0e-4_wp   !! of alpha: likewise where an element closes or turns
   real(wp), parameter :: zero_loop_area = 1.0e-9_wp !! of alpha q: the area of a loop, above the error of its points
   real(wp), parameter :: minor_area = 1.0e-6_wp     !! of alpha q: smaller areas need not settle, a loss factor of 1E-6
   real(wp), parameter :: equal_senses = 1.0e-6_wp   !! of a push: the two senses of a mode are equal
   real(wp), parameter :: largest_to_rounding = 1.0e-7_wp !! of the largest displacement: a node that moves as far; one that rests
   real(wp), parameter :: coarse_amplitude = 3.0e-3_wp !! of an amplitude: the search with coarse increments
   real(wp), parameter :: same_alpha = 1.0e-12_wp    !! of alpha: the loop jumps between two loads this close
   real(wp), parameter :: coarse_limit = 1.0e-4_wp   !! of alpha: the largest load carried, searched by coarse increments
   real(wp), parameter :: fine_limit = 1.0e-3_wp     !! of alpha: the same by fine increments, which are dear

   ! ---- results
   real(wp), parameter :: page_zero = 1.0e-9_wp      !! of the largest number of its kind: printed as zero, other processors differ
   real(wp), parameter :: least_load = 1.0e-6_wp     !! of all loads: less on a node is none, as at corners of sides of second order
   real(wp), parameter :: least_component = 0.01_wp  !! of a force between two nodes: less gives no stiffness along its direction
   real(wp), parameter :: zero_of_sums = 1.0e-9_wp   !! of the sum of amounts: forces, or works, that cancel
   real(wp), parameter :: zero_remainder = 1.0e-7_wp !! of forces and movements: a difference, zero but for the TOL of iterations
   real(wp), parameter :: zero_movement = 1.0e-7_wp  !! of the largest movement over the stage: a point that rests
   real(wp), parameter :: equal_slopes = 1.0e-9_wp   !! of the slope of loading: unloading may be as steep, but for rounding
   real(wp), parameter :: listed_share = 1.0e-4_wp   !! of the strain energy: a smaller share has no row in the listing
   real(wp), parameter :: zero_mass = 1.0e-12_wp     !! of the mass of the structure: for tables in full precision
   real(wp), parameter :: zero_loop_share = 1.0e-7_wp !! of an amplitude, of a loss: rounding of loops
   real(wp), parameter :: least_loss_factor = 1.0e-6_wp !! loss factor: a smaller one has no shares, a negative one no warning
   real(wp), parameter :: centre_floor = 5.0e-5_wp   !! of an amplitude: half of the last digit printed

   ! ---- text
   real(wp), parameter :: near_half = 1.0e-6_wp      !! of the last digit: rounding may decide; above the error of the product, 1E-9
   real(wp), parameter :: exact_power = 1.0e-6_wp    !! of a logarithm: a power of ten gives one exponent on any machine

   ! ---- fit of test data
   real(wp), parameter :: zero_coefficient = 1.0e-13_wp !! of tau: a coefficient of a branch that is rounding
   real(wp), parameter :: equal_pressures = 1.0e-3_wp !! of a pressure: default of --p-tolerance, control of a test machine
   real(wp), parameter :: equal_readings = 1.0e-6_wp !! of the stress, or of d: readings count as different from here on
   real(wp), parameter :: same_deflection = 1.0e-6_wp !! of d: a loop returns to its start
   real(wp), parameter :: whole_number = 1.0e-6_wp   !! of one: the number of a run
   real(wp), parameter :: same_unit = 1.0e-9_wp      !! of a unit: units of force, stress and length that agree
   real(wp), parameter :: settled_curve = 1.0e-14_wp !! of ln c and m: change in the last step, a few roundings
   real(wp), parameter :: settled_offset = 1.0e-13_wp !! of the unknowns with an offset: likewise, more unknowns
   real(wp), parameter :: settled_iwan = 1.0e-9_wp   !! of the unknowns of Iwan's law: change in the last step
   real(wp), parameter :: iwan_difference = 1.0e-5_wp !! of these unknowns: differences in place of derivatives
   real(wp), parameter :: not_fixed = 1.0e-3_wp      !! of a derivative: no less fixes an unknown; of beta, of the largest d: counts as none
   real(wp), parameter :: search_difference = 1.0e-2_wp !! of an unknown of --structure: differences in place of derivatives; a run has three digits
   real(wp), parameter :: beside_tol = 1.0e-6_wp     !! of the largest load: unbalanced force of a run beside another; SEARCH_DIFFERENCE moves 1E-2
   real(wp), parameter :: search_modes = 1.0e-8_wp   !! of nu, by Lanczos, in --structure: the error of a frequency is far below its deviation
   real(wp), parameter :: search_settled = 1.0e-4_wp !! of its sum of squares: change in the last step, far below one deviation
   real(wp), parameter :: round_settled = 1.0e-2_wp  !! of the same in a round; of one: between rows predicted and in full, a tenth of a deviation
   real(wp), parameter :: worth_a_round = 4.0e-2_wp  !! less in the sum of squares: the minimum is within a fifth of a deviation
   real(wp), parameter :: far_better = 9.0_wp        !! less in a sum of squares, three deviations: numbers of modes are those at the start
   real(wp), parameter :: in_the_span = 1.0e-6_wp    !! of a mode of mass 1 of another stage: what the modes of a stage lack of it
   real(wp), parameter :: other_unit = 10.0_wp       !! a factor between a value and the measured one, and deviations: a row to check
   real(wp), parameter :: close_modes = 2.0_wp       !! deviations between two frequencies: noise may have exchanged the modes
   real(wp), parameter :: least_mac = 0.3_wp         !! MAC of a mode that is followed: two that mix have 0.5
   real(wp), parameter :: undetermined = 1.0e-3_wp   !! of the largest singular value: smaller ones are errors of these differences
   real(wp), parameter :: at_bound = 5.0e-2_wp       !! cosine of z: an unknown within a thousandth of its range from a bound
   real(wp), parameter :: m_at_one = 1.0e-9_wp       !! of m: the fit of a straight line gives 1 but for rounding

end module tolerances
