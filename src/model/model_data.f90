!> The structure as it is solved: nodes, bodies, joints, supports, loads, all references resolved to positions.
!! Built once from a deck; nothing in it changes afterwards.
module model_data
   use beam_element, only: beam_law
   use coordinate_systems, only: coordinate_system
   use elasticity, only: plane_stress
   use element_kinds, only: element_table, kind_edge2
   use interface_operator, only: at_first_end, interface_element, named_node
   use joint_laws, only: joint_law
   use kinds, only: wp
   use lists, only: id_table_type
   use shell_membrane, only: shell_law
   implicit none
   private

   public :: bar_nodes, corners_of, has_gaps, has_ground_springs, has_second_order, is_beam, is_coarser, is_face_node, is_shell, &
             joint_centroid, joint_node_id, n_bars, n_points, n_rotations, n_sections, n_springs, node_kind, own_nodes, &
             place_in_kind, point_of, supported

   !> Section and material of body elements.
   type, public :: property_type
      integer  :: id = 0
      integer  :: state = plane_stress       !! of stress: plane_stress ... solid, of elasticity
      real(wp) :: thickness = 0.0_wp         !! of a plane one [length]
      real(wp) :: e = 0.0_wp, nu = 0.0_wp    !! [pressure], [-]
      real(wp) :: rho = 0.0_wp               !! mass density [force x time^2/length^4]
      real(wp) :: alpha = 0.0_wp             !! thermal expansion [1/temperature]
      real(wp) :: reference = 0.0_wp         !! TREF, at which it has no thermal strain [temperature]
      real(wp) :: damping = 0.0_wp           !! GE, structural damping [-]
      real(wp) :: strength = 0.0_wp          !! ST, 0: not given [pressure]
      logical  :: incompatible = .false.     !! modes of Wilson and Taylor
      real(wp) :: extra_mass = 0.0_wp        !! NSM of a shell, a unit of area [force x time^2/length^3]
      real(wp) :: fibre(2) = 0.0_wp          !! Z1, Z2 of a shell: heights above its mean plane where its stress is told [length]
   end type property_type

   !> Shells and beams beside what all elements have. The PLACE of a plane element in space is that of its law among SHELLS, that of a
   !! line among BEAMS.
   type, public :: structural_type
      integer, allocatable :: place(:)       !! (n_elements) 0: a body
      type(shell_law), allocatable :: shells(:)
      type(beam_law), allocatable  :: beams(:)
   end type structural_type

   !> A marked surface: sides of elements, edges in the plane and faces of solids, each in the order of its element: a plane
   !! body on the left of the edge, the right-hand normal of a face out of the solid.
   type, public :: surface_type
      integer :: id = 0
      integer :: n  = 0                      !! sides
      integer, allocatable :: corners(:)     !! (n) 2, 3 or 4
      integer, allocatable :: n_nodes(:)     !! (n) corners, and as many mid-side nodes where the side is of second order; of an edge 1
      integer, allocatable :: nodes(:, :)    !! (most of any, n) its corners, then its mid-side nodes as in element_kinds, 0 behind
      integer, allocatable :: element(:)     !! (n) the body element that the side belongs to
      integer, allocatable :: other(:)       !! (n) a body element behind the side, 0: none
      logical :: was_split = .false.         !! a joint was made of it: the other body has the twins of its nodes
      integer, allocatable :: line(:)        !! (n) of its card in the deck text
   end type surface_type

   real(wp), parameter, public :: whole_share = 0.999_wp !! share of a face or side from which on it is covered as a whole

   !> How the sides of a joint that do not match cover each other.
   type, public :: joint_cover
      logical  :: fitted = .false.           !! whether lists were fitted at all
      real(wp) :: share = 1.0_wp             !! of the area of SIDE1 that SIDE2 covers
      real(wp) :: farthest = 0.0_wp          !! largest distance of the faces, along the normal of SIDE1 [length]
      real(wp) :: spacing(2) = 0.0_wp        !! mean area, of edges length, of the faces of SIDE1 and of SIDE2 that take part
   end type joint_cover

   !> One joint: a group of interface elements with the same laws.
   !> Axes and centroid of a joint.
   type, public :: joint_frame
      logical  :: faces_all_ways = .false.  !! its mean normal says nothing, as that of a pin in its bore
      logical  :: closed = .false.          !! likewise, on a ring of the part along the axis: the axes are those of the model
      logical  :: exists(6) = .false.       !! movements that the model and the places of the elements have
      real(wp) :: axes(3, 3) = 0.0_wp       !! columns x, y, z
      real(wp) :: centroid(3) = 0.0_wp      !! of the area [length]
      real(wp) :: extent = 0.0_wp           !! largest distance of an element from it [length]
   end type joint_frame

   type, public :: joint_type
      integer  :: id = 0                     !! JID; PJID for a group of CJOINT cards
      integer  :: line = 0                   !! of its card (the first CJOINT) in the deck text
      integer  :: first = 0, last = -1       !! its interface elements
      integer  :: side_1 = 0                 !! position of the surface SIDE1; 0: single elements
      type(joint_cover) :: cover
      type(joint_law) :: law                 !! normal, shear, friction
      logical  :: e_u_given = .false.        !! whether the deck gives the unloading slope
      integer  :: n_reanalyses = 1           !! NREAN after the Coulomb check; -1: until the excess is gone
      real(wp) :: p0 = 0.0_wp                !! initial pressure given by the user, 0: none
      real(wp) :: p_av = 0.0_wp              !! pressure of the first increment, Eq. (9): that, or by statics [pressure], > 0
      real(wp) :: area = 0.0_wp              !! A_int, sum of the areas of influence [length^2]
      real(wp) :: normal(3) = 0.0_wp         !! mean normal, from side 1 to side 2
      type(joint_frame) :: frame
      character(8) :: gap_kind = ''          !! of its JGAP, blank: none
      logical  :: determinate = .false.      !! whether statics alone gives its normal resultant
      logical, allocatable :: carries(:)     !! (parts) the parts whose load it carries, where determinate
      real(wp) :: direction = 1.0_wp         !! +1: those parts are on side 1; -1: on side 2
   end type joint_type

   !> How warm everything is. What a material is warmer than its reference temperature is AT - REFERENCE_SHARE TREF: the share is 1
   !! where the deck gives temperatures, 0 where it gives none (all is at its TREF then), between them on the way.
   type, public :: temperature_type
      real(wp), allocatable :: at(:)         !! (n_nodes) [temperature]; not allocated: none are given
      real(wp) :: reference_share = 0.0_wp   !! [-]
      real(wp), allocatable :: plate(:, :)   !! (5, shells) what corners are warmer than AT [temperature], and by how much more a unit of
                                             !! height [temperature/length]; not allocated: no shell has its own
   end type temperature_type

   !> Forces on nodes, displacements of supports, temperatures: the total load at the end of a stage.
   type, public :: stage_load_type
      integer :: n = 0
      integer, allocatable  :: node(:)       !! (n), a node may stand here more than once
      real(wp), allocatable :: force(:, :)   !! (3, n)
      real(wp), allocatable :: moved(:, :)   !! (dimension, n_nodes) of held unknowns [length]; where any move
      real(wp), allocatable :: beam(:, :)    !! (12, beams) what the ends of beams bear of loads along them [force], [moment]; where any
      type(temperature_type) :: temperature
   end type stage_load_type

   integer, parameter, public :: a_point = 1, a_rotation = 2, an_overlap = 3 !! kinds of nodes
   integer, parameter, public :: a_bar = 1, a_spring = 2                     !! kinds of bars; a bolt is a bar with a BOLT card

   !> A bar, which may be a bolt, or a spring: a force that grows with its elongation, direction 2 . u_2 - direction 1 . u_1.
   type, public :: bar_type
      integer  :: id = 0
      integer  :: nodes(2) = 0               !! of a spring to the ground the second is 0
      real(wp) :: direction(3, 2) = 0.0_wp   !! at each node, unit: of a bar both from node 1 to node 2
      real(wp) :: stiffness = 0.0_wp         !! E A/L [force/length]
      logical  :: ground_first = .false.     !! of a spring: its card names the ground as its first node
      integer  :: kind = a_bar
      character(2) :: axis = ''              !! of a spring: T1, T2 or T3, as the card numbers its components
      integer  :: bolt = 0                   !! BOLT id, 0: none
      real(wp) :: preload = 0.0_wp           !! of a bolt [force]
      real(wp) :: area = 0.0_wp              !! of a bar [length^2]
      real(wp) :: strength = 0.0_wp          !! ST of its material, 0: not given [pressure]
      integer  :: stage = 0                  !! position of the stage that tightens it; a bolt is elastic from its end on
      real(wp) :: mass = 0.0_wp              !! (rho A + NSM) L of a bar [force x time^2/length]
      real(wp) :: expansion = 0.0_wp         !! alpha L [length/temperature]
      real(wp) :: reference = 0.0_wp         !! TREF [temperature]
      real(wp) :: damping = 0.0_wp           !! GE, structural damping [-]
   end type bar_type

   !> CONM2: a mass at a node.
   type, public :: point_mass_type
      integer  :: node = 0
      real(wp) :: mass = 0.0_wp              !! [force x time^2/length]
      real(wp) :: inertia(3, 3) = 0.0_wp     !! about the node, in global axes, which rotations feel [force x time^2 x length]
   end type point_mass_type

   !> The section at which a solid bolt is cut. Its nodes move with the marked side; for the elements behind it they are where
   !! they would be with the overlap g along DIRECTION on top: u + g direction. g is component 1 of a node of its own.
   type, public :: section_type
      integer  :: bolt = 0                   !! BOLT id
      integer  :: surface = 0                !! PMARK id
      integer  :: node = 0                   !! position of the node of g; its other components are held
      integer  :: point = 0                  !! a node of the section
      real(wp) :: direction(3) = 0.0_wp      !! unit, from the side behind to the marked side: g > 0 shortens the bolt
      real(wp) :: area = 0.0_wp              !! [length^2]
      real(wp) :: strength = 0.0_wp          !! ST of its material, 0: not given [pressure]
      real(wp) :: preload = 0.0_wp           !! tension [force]
      integer  :: stage = 0                  !! position of the stage that tightens it; from its end on g is held as it then is
   end type section_type

   !> The rotations of a node of shells or beams, or of a reference node, which moves with others as a rigid body: they are components
   !! of a node of their own, x, y, z in space, in the plane the first one alone, about z. What is kept there is the rotation times an
   !! arm, a displacement, so that all unknowns have one unit; the force on it is the moment by the arm.
   type, public :: rotation_type
      integer  :: point = 0                  !! the node
      integer  :: node = 0                   !! that of its rotations
      real(wp) :: arm = 1.0_wp               !! root mean square of the distances of the nodes that move with it, of an element's
                                             !! nodes from it [length]
      logical  :: of_element = .false.       !! whether shells or beams have it
   end type rotation_type

   !> A node on the face of shells: it stands off POINT, a node of the shells, by a rigid LEVER.
   type, public :: face_node_type
      integer  :: point = 0
      integer  :: node = 0
      real(wp) :: lever(3) = 0.0_wp          !! [length]
   end type face_node_type

   !> A node that the deck names by place, NODEAT, or the reference node of an RBE2M or RBE3M.
   type, public :: placed_node
      integer  :: id = 0                     !! of NODEAT; 0: a reference node
      integer  :: element = 0                !! of which rigid element; 0: NODEAT
      integer  :: surface = 0                !! PMARK, 0: none
      integer  :: node = 0
      real(wp) :: x(3) = 0.0_wp              !! the place that NODEAT gives [length]
   end type placed_node

   !> What holds: an SPC1 card, the SPC cards of one set, the SPCM card of a surface, PS of GRID.
   type, public :: support_group
      character(4) :: kind = ''              !! SPC, SPC1, SPCM, GRID; FREE: what holds a structure without supports
      integer :: id = 0                      !! SPCM: the PMARK; else the set; GRID: 0
      integer :: line = 0                    !! of the (first) card in the deck text
   end type support_group

   !> Nodes whose displacements are not their own unknowns in global axes: see node_coupling.
   type, public :: node_coupling_type
      integer :: n = 0                       !! coupled nodes
      integer, allocatable  :: of_node(:)    !! (n_nodes) which of them a node is, 0: none; not allocated where there is none
      integer, allocatable  :: first(:)      !! (at least n + 1) parts first(k) to first(k + 1) - 1 are of coupled node k:
      integer, allocatable  :: node(:)       !! (at least parts) the unknowns of this node
      real(wp), allocatable :: t(:, :, :)    !! (dimension, dimension, likewise) by this matrix [-]
   end type node_coupling_type

   type, public :: model_type
      integer :: dimension = 2               !! degrees of freedom a node
      logical :: axisymmetric = .false.      !! about y; loads, areas and forces are those of the whole ring
      integer :: n_nodes = 0
      integer :: n_filled = 0                !! of these put at the middle of edges, see node_build
      integer :: first_filled = 0            !! position of the first of them
      integer, allocatable  :: node_id(:)    !! ascending; behind the last those of rotations, then those of sections, 0
      real(wp), allocatable :: x(:, :)       !! (3, n_nodes) [length]
      integer, allocatable  :: duplicate(:)  !! (n_nodes) the node that a split surface put opposite, 0: none
      logical, allocatable  :: used(:)       !! (n_nodes) whether any element holds the node
      logical, allocatable  :: held(:, :)    !! (dimension, n_nodes) supported, component by component of its unknowns
      type(support_group), allocatable :: support_groups(:)
      logical :: floats = .false.            !! nothing but that one holds it
      integer, allocatable  :: support_of(:, :) !! (dimension, nodes at that time) the first of these that holds it, 0: none
      logical, allocatable  :: left_out(:, :) !! (dimension, n_nodes) no unknowns though not supported: components that depend on
                                             !! others, or are of reference nodes and move nothing; held too; where any are
      type(node_coupling_type) :: coupling   !! of displacements with unknowns
      integer, allocatable  :: node_system(:) !! (n_nodes) the system CD of a node, 0: global axes; where any has one
      type(placed_node), allocatable :: placed(:) !! where the deck names nodes by place; not allocated: nowhere
      type(id_table_type)   :: node_table
      integer :: n_elements = 0
      integer, allocatable  :: element_id(:)
      integer, allocatable  :: element_kind(:)       !! of element_kinds
      integer, allocatable  :: element_nodes(:, :)   !! (most of any, n_elements) nodes as on the cards, 0 behind the last
      integer, allocatable  :: element_property(:)
      integer, allocatable  :: element_line(:)       !! of its card in the deck text
      integer, allocatable  :: first_at(:)           !! (n_nodes + 1) elements_at(first_at(i):first_at(i+1)-1)
      integer, allocatable  :: elements_at(:)        !! are the elements of node i
      type(coordinate_system), allocatable :: systems(:) !! as the deck has them
      type(property_type), allocatable :: properties(:)
      type(structural_type) :: structural        !! where there are shells or beams
      type(surface_type), allocatable  :: surfaces(:)
      type(joint_type), allocatable    :: joints(:)
      type(interface_element), allocatable :: interface(:)
      type(bar_type), allocatable          :: bars(:)
      type(point_mass_type), allocatable   :: masses(:)
      logical :: lumped = .false.            !! MASS = LUMPED: the mass of elements stands at their nodes
      type(section_type), allocatable      :: sections(:)
      type(rotation_type), allocatable     :: rotations(:)
      type(face_node_type), allocatable    :: faces(:)
      integer, allocatable  :: face_of(:)            !! (points) which of these a node is, 0: none; where there are any
      integer, allocatable  :: rotation_of(:)        !! (points) which of these a node has, 0: none; where there are any
      integer, allocatable  :: node_section(:)       !! (n_nodes) the section that a node lies in, 0: none; where there are any
      integer, allocatable  :: element_section(:)    !! (n_elements) the section that an element touches from behind, likewise
      type(stage_load_type), allocatable   :: stage_loads(:)
      integer, allocatable  :: part(:)       !! (n_nodes) which connected body a node belongs to
      integer :: n_parts = 0
   end type model_type

contains

   !> Whether SIDE1 of a joint is coarser than SIDE2: its faces on the mean more than a tenth larger.
   pure logical function is_coarser(cover)
      type(joint_cover), intent(in) :: cover

      is_coarser = cover%spacing(1) > 1.1_wp*cover%spacing(2)
   end function is_coarser

   !> How many bars there are.
   pure integer function n_bars(model)
      type(model_type), intent(in) :: model

      n_bars = 0
      if (allocated(model%bars)) n_bars = size(model%bars)
   end function n_bars

   !> How many of the bars are springs.
   pure integer function n_springs(model)
      type(model_type), intent(in) :: model

      n_springs = 0
      if (allocated(model%bars)) n_springs = count(model%bars%kind == a_spring)
   end function n_springs

   !> Whether any spring stands on the ground.
   pure logical function has_ground_springs(model)
      type(model_type), intent(in) :: model

      has_ground_springs = .false.
      if (allocated(model%bars)) has_ground_springs = any(model%bars%nodes(2) == 0)
   end function has_ground_springs

   !> The nodes of BAR, without the ground.
   pure function bar_nodes(bar) result(nodes)
      type(bar_type), intent(in) :: bar
      integer, allocatable :: nodes(:)

      nodes = pack(bar%nodes, bar%nodes > 0)
   end function bar_nodes

   !> How many sections of solid bolts there are.
   pure integer function n_sections(model)
      type(model_type), intent(in) :: model

      n_sections = 0
      if (allocated(model%sections)) n_sections = size(model%sections)
   end function n_sections

   !> Whether the deck gives the initial gap of any joint.
   pure logical function has_gaps(model)
      type(model_type), intent(in) :: model

      has_gaps = any(model%joints%gap_kind /= '')
   end function has_gaps

   !> The centroid of the area of JOINT [length].
   pure function joint_centroid(model, joint) result(centroid)
      type(model_type), intent(in) :: model
      type(joint_type), intent(in) :: joint
      real(wp) :: centroid(3)
      integer  :: i

      centroid = 0.0_wp
      do i = joint%first, joint%last
         centroid = centroid + model%interface(i)%area*at_first_end(model%interface(i), model%x)/joint%area
      end do
   end function joint_centroid

   !> How many nodes are points of the structure; the nodes of sections follow.
   pure integer function n_points(model)
      type(model_type), intent(in) :: model

      n_points = model%n_nodes - n_sections(model) - n_rotations(model)
   end function n_points

   !> What the unknowns of NODE are. Behind the points stand the nodes of rotations, behind these those of sections.
   pure integer function node_kind(model, node) result(kind)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      kind = a_point
      if (node > n_points(model)) kind = a_rotation
      if (node > n_points(model) + n_rotations(model)) kind = an_overlap
   end function node_kind

   !> Which of its kind NODE is: a point, or that of model%rotations or model%sections.
   pure integer function place_in_kind(model, node) result(place)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      place = node
      if (node_kind(model, node) /= a_point) place = place - n_points(model)
      if (node_kind(model, node) == an_overlap) place = place - n_rotations(model)
   end function place_in_kind

   !> The point whose rotations NODE is; else itself.
   pure integer function point_of(model, node) result(point)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      point = node
      if (node_kind(model, node) == a_rotation) point = model%rotations(place_in_kind(model, node))%point
   end function point_of

   !> How many reference nodes with rotations there are.
   pure integer function n_rotations(model)
      type(model_type), intent(in) :: model

      n_rotations = 0
      if (allocated(model%rotations)) n_rotations = size(model%rotations)
   end function n_rotations

   !> Which components of NODE a support holds.
   pure function supported(model, node) result(held)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      logical :: held(model%dimension)

      held = model%held(:, node)
      if (allocated(model%left_out)) held = held .and. .not. model%left_out(:, node)
   end function supported

   !> The number of the node that interface element I names for END 1 or 2: 0 for a rigid base, -1 where several share end 2.
   pure integer function joint_node_id(model, i, end) result(id)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i, end

      id = named_node(model%interface(i), end)
      if (id > 0) id = model%node_id(id)
   end function joint_node_id

   !> The nodes of element E, corners first.
   pure function corners_of(model, e) result(nodes)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      integer :: nodes(element_table(model%element_kind(e))%n_nodes)

      nodes = model%element_nodes(:size(nodes), e)
   end function corners_of

   !> Whether element E is a shell.
   pure logical function is_shell(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      is_shell = .false.
      if (allocated(model%structural%place)) is_shell = model%structural%place(e) > 0 .and. model%element_kind(e) /= kind_edge2
   end function is_shell

   !> Whether NODE stands on the face of shells.
   pure logical function is_face_node(model, node)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      is_face_node = .false.
      if (.not. allocated(model%face_of)) return
      if (node <= size(model%face_of)) is_face_node = model%face_of(node) > 0
   end function is_face_node

   !> Whether element E is a beam.
   pure logical function is_beam(model, e)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e

      is_beam = model%element_kind(e) == kind_edge2
   end function is_beam

   !> The nodes of element E, of a shell or beam behind them the nodes of their rotations.
   pure function own_nodes(model, e) result(nodes)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: e
      integer, allocatable :: nodes(:)

      nodes = corners_of(model, e)
      if (.not. allocated(model%structural%place)) return
      if (model%structural%place(e) > 0) nodes = [nodes, model%rotations(model%rotation_of(nodes))%node]
   end function own_nodes

   !> Whether MODEL has elements of second order.
   pure logical function has_second_order(model)
      type(model_type), intent(in) :: model

      has_second_order = any(element_table(model%element_kind)%linear /= model%element_kind)
   end function has_second_order

end module model_data
