!> Stores the bulk data of a deck as read: one array for each kind of card, in the order of the deck, unresolved.
!! The component LINE is always the index of the card's first line in the deck text. Messages need it.
module bulk_data
   use beam_sections, only: beam_section
   use card_fields, only: id_ranges
   use elasticity, only: plane_stress
   use element_kinds, only: max_nodes
   use frequency_loads, only: response_cards_type
   use kinds, only: wp
   use load_data, only: bolt_card, displacement_card, force_card, gravity_card, load_card, pair_card, &
                        own_temperature_card, preload_card, pressure_card, region_card, surface_load_card, temperature_card
   use nastran_compatibility, only: ignored_entries_type, parameters_type
   use nodal_matrices, only: matrix_cards_type
   use normal_curve, only: normal_law
   use iwan_law, only: iwan_type
   use shear_stiffness, only: shear_law
   use tapered_beam, only: beam_station
   use text_tools, only: text_item
   implicit none
   private

   type, public :: grid_card
      integer  :: line = 0, id = 0, ps = 0
      integer  :: cp = 0, cd = 0                        ! systems of the coordinates X and of displacements, 0: global axes
      real(wp) :: x(3) = 0.0_wp
      logical  :: doubtful = .false.                    ! a field could not be read
      logical  :: is_scalar = .false.                   ! a scalar point
   end type grid_card

   !> A coordinate system, by three points in system REFERENCE (CORD2) or by three NODES (CORD1): the origin, a point on z, one in x-z.
   type, public :: system_card
      integer  :: line = 0, id = 0
      integer  :: kind = 0                              ! of coordinate_systems
      integer  :: reference = 0                         ! 0: global axes
      real(wp) :: points(3, 3) = 0.0_wp
      integer  :: nodes(3) = 0                          ! 0: given by points
      integer  :: field = 1                             ! data field of the id
   end type system_card

   integer, parameter, public :: edge_cbar = 0, edge_crod = -1, edge_cbeam = -2 !! kinds of edge

   !> An element with nodes: an element of a body, or a face of a marked surface.
   type, public :: element_card
      integer :: line = 0, id = 0, property = 0
      integer :: kind = 0                               ! of element_kinds; for an edge one of the kinds above
      integer :: nodes(max_nodes) = 0                   ! corners, then mid-side nodes; 0 where the field is blank
   end type element_card

   !> CBAR, CBEAM, CROD: a mark, a beam or a bolt. NODES(:2) are its ends; NODES(3), G0, may be the mid-side node of a marked edge.
   type, extends(element_card), public :: edge_card
      real(wp) :: orientation(3) = 0.0_wp, offset(3, 2) = 0.0_wp ! X1, X2, X3 where there is no G0; WA, WB
      integer  :: pins(2) = 0                           ! PA, PB
      logical  :: blank(5) = .false.                    ! X1, X2, X3, PID, OFFT
      logical  :: in_basic = .false.                    ! OFFT B: X1, X2, X3 are in basic axes
   end type edge_card

   !> Additional data of a shell card: the position of its element_card, ZOFFS, T1 to T4, THETA and MCID.
   type, public :: plate_card
      integer  :: element = 0
      real(wp) :: offset = 0.0_wp, thickness(4) = 0.0_wp ! 0: that of the PSHELL
      logical  :: is_relative = .false.                 ! TFLAG: T1 to T4 are shares of T
      real(wp) :: angle = 0.0_wp                        ! THETA, in degrees
      integer  :: system = -1                           ! MCID; -1: THETA
   end type plate_card

   !> PBAR, PBARL, PBEAM, PBEAML.
   type, public :: beam_property_card
      integer  :: line = 0, id = 0, material = 0
      character(6) :: name = ''
      type(beam_section) :: section
      real(wp) :: extra_mass = 0.0_wp                   ! NSM, per length
      type(beam_station), allocatable :: stations(:)    ! where the section changes
   end type beam_property_card

   !> PLOAD1: the load P at the positions X(1) and X(2).
   type, public :: beam_load_card
      integer  :: line = 0, set = 0, element = 0
      integer  :: kind = 1                              ! 1 to 3 a force, 4 to 6 a moment in global axes, 7 to 12 in beam axes
      logical  :: is_fraction = .false., is_projected = .false.
      real(wp) :: x(2) = 0.0_wp, p(2) = 0.0_wp
   end type beam_load_card

   type, public :: ply_card
      integer  :: id = 0, material = 0, at = 0          ! AT is the data field of MID
      real(wp) :: thickness = 0.0_wp, angle = 0.0_wp    ! in degrees
      logical  :: shown = .false.                       ! SOUT
   end type ply_card

   !> PSHELL, PCOMP, PAXIS and PSOLID.
   type, public :: property_card
      integer  :: line = 0, id = 0, material = 0
      character(6) :: name = 'PSHELL'                   ! or PCOMP
      integer  :: state = plane_stress                  ! of elasticity
      real(wp) :: thickness = 0.0_wp                    ! of a PSHELL
      logical  :: incompatible = .false.                ! modes of Wilson and Taylor
      integer  :: bending = 0, shear = 0, system = 0    ! MID2 and MID3 of a PSHELL, 0: blank; CORDM of a PSOLID
      logical  :: bends_alone = .false.                 ! MID1 is blank: no membrane; MATERIAL is MID2
      real(wp) :: inertia_ratio = 1.0_wp, shear_ratio = 5.0_wp/6.0_wp ! 12I/T**3, TS/T
      real(wp) :: extra_mass = 0.0_wp                   ! NSM, per area
      real(wp) :: fibre(2) = 0.0_wp                     ! Z1, Z2
      logical  :: fibre_given(2) = .false.
      integer  :: material_at = 2                       ! data field of MATERIAL
      type(ply_card), allocatable :: plies(:)           ! of a PCOMP
      real(wp) :: lowest = 0.0_wp                       ! Z0
      real(wp) :: reference = 0.0_wp, damping = 0.0_wp  ! TREF and GE of a PCOMP
   end type property_card

   type, public :: prod_card
      integer  :: line = 0, id = 0, material = 0
      real(wp) :: area = 0.0_wp, torsion = 0.0_wp, extra_mass = 0.0_wp ! A, J, NSM per length
   end type prod_card

   !> CONROD: a bar with its own cross-section; its id is that of the element.
   type, extends(prod_card), public :: conrod_card
      integer :: nodes(2) = 0
   end type conrod_card

   !> CELAS1 to 4 and CDAMP1 to 4 (between component COMPONENTS(1) of node 1 and COMPONENTS(2) of node 2), CBUSH (along three axes).
   type, public :: spring_card
      integer  :: line = 0, id = 0, nodes(2) = 0        ! 0: the ground
      integer  :: property = 0                          ! PELAS, PDAMP, PBUSH or PVISC; 0: the values below
      integer  :: components(2) = 0
      logical  :: is_bush = .false., is_damper = .false. ! CBUSH; CDAMP1 to 4; both: CVISC
      logical  :: is_scalar = .false.                   ! CELAS3 and 4, CDAMP3 and 4
      integer  :: system = -1                           ! CID of a CBUSH, 0: global axes, -1: blank
      integer  :: other = 0                             ! GO of a CBUSH, 0: blank
      real(wp) :: orientation(3) = 0.0_wp               ! X1, X2, X3
      integer  :: point_system = -1                     ! OCID, -1: the point divides the line between the nodes at SHARE
      real(wp) :: share = 0.5_wp, point(3) = 0.0_wp     ! S; S1, S2, S3
      real(wp) :: stiffness = 0.0_wp, damping = 0.0_wp  ! of a CELAS2: K and GE
      real(wp) :: viscous = 0.0_wp                      ! of a CDAMP2: B
   end type spring_card

   !> PELAS (the first stiffness), PDAMP (the first B) and PBUSH.
   type, public :: spring_property_card
      integer  :: line = 0, id = 0
      logical  :: is_bush = .false., is_damper = .false. ! PBUSH; PDAMP; both: PVISC
      integer  :: field = 1                             ! data field of the id
      real(wp) :: stiffness(6) = 0.0_wp, viscous(6) = 0.0_wp ! K and B
      real(wp) :: damping(6) = 0.0_wp                   ! GE, of a PELAS the first
      real(wp) :: mass = 0.0_wp                         ! M of a PBUSH
   end type spring_property_card

   !> SPOINT: scalar points, which have one component.
   type, extends(id_ranges), public :: scalar_card
      integer :: line = 0
   end type scalar_card

   !> PMASS: one of its masses.
   type, public :: pmass_card
      integer  :: line = 0, id = 0
      real(wp) :: mass = 0.0_wp
   end type pmass_card

   !> CONM1, CONM2: a mass at a node; CMASS1 to 4: a mass that resists along one component of it, less COMPONENT_2 of NODE_2.
   type, public :: mass_card
      integer  :: line = 0, id = 0, node = 0, node_2 = 0
      integer  :: component = 0, component_2 = 0
      logical  :: is_directed = .false., is_scalar = .false. ! CMASS1 to 4; of these CMASS3 and CMASS4
      integer  :: property = 0                          ! PMASS, 0: MASS is given
      real(wp) :: mass = 0.0_wp
      real(wp), allocatable :: matrix(:)                ! of a CONM1: M11, M21, M22, ..., M66
      integer  :: system = 0                            ! CID of offset and inertia, 0: global axes
      real(wp) :: offset(3) = 0.0_wp                    ! X1 to X3: from the node to the centre of mass
      real(wp) :: inertia(6) = 0.0_wp                   ! I11, I21, I22, I31, I32, I33, about the centre of mass
   end type mass_card

   type, public :: mat1_card
      integer  :: line = 0, id = 0
      logical  :: bars_only = .false., reference_given = .false. ! no NU for bodies; TREF is given
      real(wp) :: e = 0.0_wp, nu = 0.0_wp, rho = 0.0_wp
      real(wp) :: shear = 0.0_wp, damping = 0.0_wp      ! G of torsion and transverse shear; GE
      real(wp) :: alpha = 0.0_wp, reference = 0.0_wp    ! A and TREF
      real(wp), allocatable :: solid(:, :)              ! (6, 7) of a MAT9: stress of unit strains, then A1 to A6
      real(wp) :: strength = 0.0_wp                     ! ST, 0: blank
      character(4) :: name = 'MAT1'                     ! MAT9; MAT2 or MAT8: of shells alone, with the values below
      real(wp) :: stress(3, 3) = 0.0_wp, expansions(3) = 0.0_wp, shear_moduli(2) = 0.0_wp
   end type mat1_card

   !> SPC, SPC1 and SPCM: the nodes FIRST(k) to LAST(k), or all nodes of a marked surface.
   type, extends(id_ranges), public :: support_card
      integer :: line = 0, set = 0, components = 0
      integer :: surface = 0                            ! PMARK id, 0: the nodes below
      real(wp) :: value = 0.0_wp                        ! D of an SPC, which has one node
   end type support_card

   !> RBE2, RBAR: the NODES move with the reference node as a rigid body, each in its DIRECTIONS. RBE3: the COMPONENTS of the reference
   !! node are the weighted mean of the NODES, each with its WEIGHT in its DIRECTIONS.
   type, public :: rigid_card
      integer :: line = 0, id = 0
      logical :: is_mean = .false.                      ! RBE3
      integer :: node = 0, components = 0               ! the reference node; RBE2, RBAR: the components are the directions
      integer :: node_at = 2, components_at = 3         ! data fields of both
      integer :: surface = 0                            ! RBE2M, RBE3M: PMARK of the nodes; 0: listed
      integer, allocatable  :: nodes(:), directions(:), at(:) ! AT(k): data field of NODES(k)
      real(wp), allocatable :: weight(:)
      integer, allocatable  :: um_nodes(:), um_components(:), um_at(:) ! RBE3 with UM: dependent in place of COMPONENTS. RBE1, and
                                                        ! RBAR with both ends independent: six independent components
      logical :: is_rod = .false.                       ! RROD: the distance of two nodes is constant
      real(wp) :: alpha = 0.0_wp, reference = 0.0_wp    ! coefficient of thermal expansion, TREF
      integer  :: alpha_at = 0                          ! its data field
   end type rigid_card

   !> NODEAT: a second number for the node nearest to X.
   type, public :: place_card
      integer  :: line = 0, id = 0, surface = 0         ! SURFACE: a PMARK to whose nodes the search is limited; 0: all
      real(wp) :: x(3) = 0.0_wp
   end type place_card

   !> MPC: the sum of FACTOR(k) times COMPONENT(k) of NODE(k) is zero; the first term is dependent.
   type, public :: equation_card
      integer :: line = 0, set = 0
      integer, allocatable  :: node(:), component(:), at(:) ! AT(k): data field of NODE(k)
      real(wp), allocatable :: factor(:)
   end type equation_card

   !> SPCADD, MPCADD: the union of SETS of supports or of constraint equations.
   type, public :: set_sum_card
      integer :: line = 0, set = 0
      integer, allocatable :: sets(:), at(:)            ! AT(k): data field of SETS(k)
   end type set_sum_card

   !> SHELLTO: the marked edge of shells SURFACES(1) moves with the marked face SURFACES(2).
   type, public :: tie_card
      integer :: line = 0, surfaces(2) = 0
   end type tie_card

   !> BLOCK2 and BLOCK3.
   type, public :: block_card
      integer  :: line = 0, id = 0, property = 0, dimension = 2
      integer  :: divisions(3) = [1, 1, 0]              ! of a BLOCK2 along sides 1-2 and 1-4, and 0
      real(wp) :: corner(3, 4) = 0.0_wp                 ! of a BLOCK3 two opposite corners
      real(wp) :: grading(3) = 1.0_wp                   ! ratio of the last division to the first
      integer  :: first_node = 1, first_element = 1
      integer  :: marks(6) = 0                          ! PMARK of sides 1-2, 2-3, 3-4, 4-1, or x low, x high, y low, ...
      integer  :: weld = 0                              ! block whose coincident nodes are used
      integer  :: order = 1                             ! of the elements
      logical  :: doubtful = .false.                    ! a field could not be read
   end type block_card

   type, public :: pmark_card
      integer :: line = 0, id = 0
   end type pmark_card

   integer, parameter, public :: fit_auto = 1, fit_yes = 2, fit_no = 3 !! faces are fitted: where nodes do not match, always, never
   type, public :: joint_card
      integer  :: line = 0, id = 0, law = 0, sides(2) = 0, fit = fit_auto
      real(wp) :: tolerance = 0.0_wp                    ! 0: default
      logical  :: is_linear = .false.                   ! PRESSURE LINEAR: elements at the Gauss points of the sides
      logical  :: is_glued = .false.                    ! of a BGSET: no joint, the sides move together; behind all joints
   end type joint_card

   type, public :: cjoint_card
      integer  :: line = 0, id = 0, law = 0, nodes(2) = 0
      real(wp) :: area = 0.0_wp, normal(3) = 0.0_wp
   end type cjoint_card

   type, public :: pjoint_card
      integer  :: line = 0, id = 0, normal_law = 0
      integer  :: shear_laws(2) = 0                     ! along x and y of the joint, 0: none
      integer  :: n_reanalyses = 1
      integer  :: iwan_law = 0                          ! 0: none
      real(wp) :: mu = 0.0_wp, p0 = 0.0_wp, p_ref = 0.0_wp
      logical  :: mu_given = .false., p0_given = .false.
   end type pjoint_card

   type, public :: jnorm_card
      integer :: line = 0, id = 0
      type(normal_law) :: law
      logical :: e_u_given = .false.
   end type jnorm_card

   type, public :: jshear_card
      integer  :: line = 0, id = 0
      type(shear_law) :: law
   end type jshear_card

   type, public :: jiwan_card
      integer :: line = 0, id = 0
      type(iwan_type) :: law                            ! p_ref is that of PJOINT
   end type jiwan_card

   type, public :: jgap_card
      integer  :: line = 0, joint = 0
      character(8) :: kind = ''                         ! CONST, PLANE, TABLE, NODES, TRUE
      real(wp) :: g0 = 0.0_wp, slope(2) = 0.0_wp, crown(2) = 0.0_wp ! of PLANE; the first of CONST too
      integer, allocatable  :: node(:)                  ! of NODES
      real(wp), allocatable :: x(:, :)                  ! (3, n) points of TABLE
      real(wp), allocatable :: gap(:)                   ! of NODES and TABLE
      integer, allocatable  :: at(:)                    ! first data field of each entry
   end type jgap_card

   type, public :: jincr_card
      integer :: line = 0, id = 0
      real(wp), allocatable :: fractions(:)                ! of the stage's load change; their sum is 1
   end type jincr_card

   !> EIGRL, EIGR: the range of natural frequencies and the scaling of the mode shapes.
   type, public :: eigrl_card
      integer  :: line = 0, id = 0
      logical  :: has_lowest = .false., has_highest = .false.
      real(wp) :: lowest = 0.0_wp, highest = 0.0_wp     ! V1, V2
      integer  :: most = 0                              ! ND, 0: blank
      logical  :: unit_mass = .true.                    ! NORM = MASS
      logical  :: by_point = .false.                    ! EIGR, NORM = POINT
   end type eigrl_card

   !> JAMPL: N amplitudes of MODE in geometric progression, from LARGEST to RATIO times LARGEST.
   type, public :: jampl_card
      integer  :: line = 0, id = 0, mode = 0, n = 0
      real(wp) :: largest = 0.0_wp, ratio = 0.0_wp
      integer  :: cycles = 0                            ! largest number, after the second loop
      integer  :: increments = 0                        ! from rest to a turning point
      integer  :: node = 0                              ! node whose displacement is the amplitude, 0: the node that moves most
      real(wp) :: tolerance = 0.0_wp                    ! of the loss factor
   end type jampl_card

   !> FREQ1: frequencies FIRST + k STEP, k = 0 to N; FREQ2: FIRST (LAST/FIRST)**(k/N). FREQ4: N frequencies from 1 - SPREAD to
   !! 1 + SPREAD times the frequency of every mode from FIRST to LAST. FREQ: LIST; FREQ5: LIST times every such mode. FREQ3: N
   !! frequencies between neighbours among FIRST, such modes and LAST.
   type, public :: frequency_card
      integer  :: line = 0, set = 0, n = 0
      real(wp) :: first = 0.0_wp, last = 0.0_wp         ! LAST is 0: a FREQ or FREQ1
      real(wp) :: step = 0.0_wp, spread = 0.0_wp        ! of a FREQ1; of a FREQ4, else 0
      real(wp) :: cluster = 0.0_wp                      ! of a FREQ3, else 0
      logical  :: is_log = .false.                      ! of a FREQ3
      real(wp), allocatable :: list(:)                  ! of a FREQ or FREQ5, ascending
   end type frequency_card

   !> TABDMP1: damping as a function of frequency, in ascending order.
   type, public :: tabdmp1_card
      integer      :: line = 0, id = 0
      character(8) :: kind = 'G'                        ! G, CRIT, Q
      real(wp), allocatable :: frequency(:), value(:)
   end type tabdmp1_card

   !> All cards of a deck.
   type, public :: bulk_data_type
      integer :: n_cards = 0, n_manual = 0                 !! cards of all kinds; parts joined to others by node numbers alone
      integer, allocatable :: part_lines(:), joined(:, :)  !! lines of BEGIN SUPER; (4, pairs) of SECONCT: GA, GB, line, data field
      real(wp) :: join_distance = 0.0_wp                   !! the largest TOL of SEBULK and SECONCT [length]
      type(ignored_entries_type) :: ignored                !! entries without effect, also of case control
      type(parameters_type) :: parameters
      type(grid_card), allocatable         :: grid(:)
      type(grid_card)                      :: grid_defaults !! CP, CD and PS of GRDSET
      type(system_card), allocatable       :: system(:)
      type(element_card), allocatable      :: element(:)   !! of bodies; faces of marked surfaces too
      type(edge_card), allocatable         :: edge(:)      !! CBAR, CBEAM and CROD
      type(edge_card)                      :: edge_defaults(2) !! of BAROR and BEAMOR
      type(plate_card), allocatable        :: plate(:)     !! of elements with ZOFFS, T1 to T4, THETA
      integer                              :: n_plates = 0 !! of PLATE that are filled
      type(beam_property_card), allocatable :: beam_property(:)
      type(beam_load_card), allocatable    :: beam_load(:)
      type(property_card), allocatable     :: pshell(:), paxis(:), psolid(:)
      type(prod_card), allocatable         :: prod(:)
      type(conrod_card), allocatable       :: conrod(:)
      type(spring_card), allocatable       :: spring(:)
      type(spring_property_card), allocatable :: spring_property(:)
      type(mass_card), allocatable         :: mass(:)
      type(pmass_card), allocatable        :: pmass(:)
      type(scalar_card), allocatable       :: scalar(:)
      type(mat1_card), allocatable         :: mat1(:)
      type(support_card), allocatable      :: support(:)
      type(set_sum_card), allocatable      :: support_sum(:), equation_sum(:), contact_sum(:), glue_sum(:)
      type(rigid_card), allocatable        :: rigid(:)
      type(place_card), allocatable        :: place(:)
      type(tie_card), allocatable          :: tie(:)
      type(equation_card), allocatable     :: equation(:)
      type(force_card), allocatable        :: force(:)
      type(pressure_card), allocatable     :: pressure(:)
      type(surface_load_card), allocatable :: surface_load(:)
      type(gravity_card), allocatable      :: gravity(:)
      type(displacement_card), allocatable :: displacement(:), suport(:)
      type(temperature_card), allocatable  :: temperature(:)
      type(own_temperature_card), allocatable :: own_temperature(:)
      type(load_card), allocatable         :: load(:), dload(:)
      type(bolt_card), allocatable         :: bolt(:)
      type(region_card), allocatable       :: region(:)
      type(pair_card), allocatable         :: pair(:)
      type(preload_card), allocatable      :: preload(:)
      type(text_item), allocatable         :: told(:)      !! what contact and bolts of NX have become; not allocated: there are none
      type(block_card), allocatable        :: block(:)
      type(pmark_card), allocatable        :: pmark(:)
      type(joint_card), allocatable        :: joint(:)
      type(cjoint_card), allocatable       :: cjoint(:)
      type(pjoint_card), allocatable       :: pjoint(:)
      type(jnorm_card), allocatable        :: jnorm(:)
      type(jshear_card), allocatable       :: jshear(:)
      type(jiwan_card), allocatable        :: jiwan(:)
      type(jgap_card), allocatable         :: jgap(:)
      type(jincr_card), allocatable        :: jincr(:)
      type(eigrl_card), allocatable        :: eigrl(:)
      type(jampl_card), allocatable        :: jampl(:)
      type(frequency_card), allocatable    :: frequency(:)
      type(tabdmp1_card), allocatable      :: tabdmp1(:)
      type(response_cards_type)            :: dynamic      !! RLOAD1 and others
      type(matrix_cards_type)              :: matrices     !! DMIG, ASET and others
   end type bulk_data_type

end module bulk_data
