!> The structure as it is solved: nodes, elements, joints, supports and loads; references are positions.
!! It is built once from a deck and does not change afterwards.
module model_data
   use beam_element, only: beam_law
   use bolt_threads, only: thread_type
   use coordinate_systems, only: coordinate_system
   use elasticity, only: plane_stress
   use interface_operator, only: interface_element, named_node
   use joint_laws, only: joint_law
   use kinds, only: wp
   use lists, only: id_table_type
   use shell_element, only: most_shell_nodes
   use shell_membrane, only: shell_law
   use text_tools, only: text_item
   implicit none
   private

   public :: bar_nodes, damped_bars, joint_node_id, n_bars, n_sections, supported

   !> Section and material of body elements.
   type, public :: property_type
      integer  :: id = 0, state = plane_stress !! of stress: plane_stress ... solid, as in elasticity
      real(wp) :: thickness = 0.0_wp         !! of a plane body [length]
      real(wp) :: e = 0.0_wp, nu = 0.0_wp    !! [pressure], [-]
      real(wp) :: rho = 0.0_wp               !! mass density [force x time^2/length^4]
      real(wp) :: alpha = 0.0_wp             !! thermal expansion [1/temperature]
      real(wp) :: reference = 0.0_wp         !! TREF, temperature without thermal strain [temperature]
      real(wp) :: damping = 0.0_wp, strength = 0.0_wp !! GE, structural damping [-]; ST, 0: not given [pressure]
      real(wp), allocatable :: solid(:, :)   !! (6, 7) of a MAT9: [D], then the free thermal strains per degree
      logical  :: incompatible = .false., is_coupled = .false. !! modes of Wilson and Taylor; MAT9: not orthotropic along x, y, z
      real(wp) :: extra_mass = 0.0_wp        !! NSM of a shell, mass per unit area [force x time^2/length^3]
      real(wp) :: fibre(2) = 0.0_wp          !! Z1, Z2 of a shell: heights above its mean plane where stresses are reported [length]
   end type property_type

   !> Laws of shells and beams, in addition to the data of all elements. PLACE is the position of a law: in SHELLS for a plane
   !! element in space, in BEAMS for a line.
   type, public :: structural_type
      integer, allocatable :: place(:)       !! (n_elements) 0: a body; empty: all are
      type(shell_law), allocatable :: shells(:)
      type(beam_law), allocatable  :: beams(:)
   end type structural_type

   !> The stages that tighten a bolt, positions in ascending order, and its preload at the end of each. It is locked after each of them.
   type, public :: tightening_type
      integer, allocatable  :: stage(:)
      real(wp), allocatable :: preload(:)    !! [force]
   contains
      procedure :: is_in
      procedure :: preload_in
      procedure :: last_until
   end type tightening_type

   !> A marked surface: sides of elements, edges in the plane and faces of solids. Each side has the node order of its element: a
   !! plane body lies on the left of an edge, the right-hand normal of a face points out of the solid.
   type, public :: surface_type
      integer :: id = 0
      integer :: n  = 0                      !! number of sides
      integer, allocatable :: corners(:)     !! (n) 2, 3 or 4
      integer, allocatable :: n_nodes(:)     !! (n) corners, and as many mid-side nodes if the side is second-order; of an edge 1
      integer, allocatable :: nodes(:, :)    !! (largest number, n) its corners, then mid-side nodes as in element_kinds, 0 behind
      integer, allocatable :: element(:)     !! (n) the body element that the side belongs to
      integer, allocatable :: other(:)       !! (n) a body element behind the side, 0: none
      integer, allocatable :: strip(:)       !! (n) which strip over the thickness, on an edge of shells, see shell_faces; 0: none
      logical :: was_split = .false.         !! a joint split the surface: the other body has duplicates of its nodes
      integer, allocatable :: line(:)        !! (n) of its card in the deck text
      integer :: joint = 0                   !! the JOINT card that has these sides of a surface of several joints, 0: the whole surface
   end type surface_type

   real(wp), parameter, public :: whole_share = 0.999_wp !! share of a face or side above which the whole of it counts as covered

   !> Coverage of the sides of a joint whose meshes do not match.
   type, public :: joint_cover
      logical  :: fitted = .false.           !! whether a mortar projection was made
      real(wp) :: share = 1.0_wp             !! share of the area of SIDE1 that SIDE2 covers
      real(wp) :: farthest = 0.0_wp          !! largest distance of the faces, along the normal of SIDE1 [length]
      real(wp) :: sagitta(2) = 0.0_wp        !! largest of the chords of curved SIDE1, SIDE2 [length]
      real(wp) :: spacing(2) = 0.0_wp        !! mean area (of edges: length) of the facing sides of SIDE1 and of SIDE2
   end type joint_cover

   !> Axes and centroid of a joint.
   type, public :: joint_frame
      logical  :: faces_all_ways = .false.  !! the mean normal is no direction of the joint, as for a pin in its bore
      logical  :: closed = .false.          !! the same, for a ring with the axial part of the normal: axes of the model
      logical  :: exists(6) = .false.       !! movements that the model and the positions of the elements permit
      real(wp) :: axes(3, 3) = 0.0_wp       !! columns x, y, z
      real(wp) :: centroid(3) = 0.0_wp      !! of the area [length]
      real(wp) :: extent = 0.0_wp           !! largest distance of an element from the centroid [length]
   end type joint_frame

   !> One joint: a group of interface elements with the same laws.
   type, public :: joint_type
      integer  :: id = 0                     !! JID; PJID for a group of CJOINT cards
      integer  :: line = 0                   !! of its card (the first CJOINT) in the deck text
      integer  :: first = 0, last = -1       !! first and last of its interface elements
      integer  :: side_1 = 0                 !! position of the surface SIDE1; 0: single elements
      type(joint_cover) :: cover
      type(joint_law) :: law                 !! normal, shear, friction
      logical  :: e_u_given = .false.        !! whether the deck gives the unloading slope
      integer  :: n_reanalyses = 1           !! NREAN after the Coulomb check; -1: until the excess is gone
      real(wp) :: p0 = 0.0_wp                !! initial pressure given by the user, 0: none
      real(wp) :: p_av = 0.0_wp              !! pressure of the first increment, Eq. (9): P0, or from statics [pressure], > 0
      real(wp) :: area = 0.0_wp              !! A_int, sum of the tributary areas [length^2]
      real(wp) :: normal(3) = 0.0_wp         !! mean normal, from side 1 to side 2
      type(joint_frame) :: frame
      character(8) :: gap_kind = ''          !! of its JGAP, blank: no JGAP
      logical  :: determinate = .false.      !! whether statics alone determines its normal resultant
      logical, allocatable :: carries(:)     !! (parts) the parts whose load it carries, where determinate
      real(wp) :: direction = 1.0_wp         !! +1: these parts are on side 1; -1: on side 2
   end type joint_type

   !> Temperatures of the model. T - TREF of a material is AT - REFERENCE_SHARE TREF. The share is 1 where the deck gives
   !! temperatures and 0 where it gives none (the structure is at TREF then); it varies linearly over a stage between the two.
   integer, parameter, public :: slope_row = most_shell_nodes + 1 !! of the temperatures of shells

   type, public :: temperature_type
      real(wp), allocatable :: at(:)         !! (n_nodes) [temperature]; not allocated: none are given
      real(wp) :: reference_share = 0.0_wp   !! [-]
      real(wp), allocatable :: own(:, :)     !! (slope_row, own_column) temperatures of shells, beams and bars: at nodes, relative to AT
                                             !! [temperature], of bars the mean; gradient of shells, in rows 3 to 6 those of beams, over the
                                             !! section [temperature/length]; not allocated: no element has temperatures of its own
   end type temperature_type

   !> Forces on nodes, displacements of supports and temperatures: the total load at the end of a stage.
   type, public :: stage_load_type
      integer :: from = 0                    !! position of the stage from whose end it starts, 0: the structure at rest
      integer :: n = 0
      integer, allocatable  :: node(:)       !! (n); a node may occur more than once
      real(wp), allocatable :: force(:, :)   !! (3, n)
      real(wp), allocatable :: moved(:, :)   !! (dimension, n_nodes) of held unknowns [length]; allocated if any is moved
      real(wp), allocatable :: beam(:, :)    !! (12, beams) end forces of the loads along beams [force], [moment]; if there are any
      type(temperature_type) :: temperature
      logical :: changes(3) = .false.        !! forces or support movements, pressures, temperatures differ from those at its start
   end type stage_load_type

   integer, parameter, public :: a_point = 1, a_rotation = 2, an_overlap = 3 !! kinds of nodes
   integer, parameter, public :: a_bar = 1, a_spring = 2, a_matrix = 3       !! kinds of bars; a bolt is a bar with a BOLT card

   !> A bar (a bolt is a bar with a BOLT card) or a spring. Its elongation is direction 2 . u_2 - direction 1 . u_1.
   type, public :: bar_type
      integer  :: id = 0
      integer  :: nodes(2) = 0               !! the second is 0 for a spring to the ground
      real(wp) :: direction(3, 2) = 0.0_wp   !! unit vector at each node: of a bar both from node 1 to node 2
      real(wp) :: stiffness = 0.0_wp         !! E A/L [force/length]
      logical  :: ground_first = .false.     !! of a spring: its card names the ground as its first node
      integer  :: kind = a_bar
      character(2) :: axis = ''              !! of a spring: T1, T2 or T3, as the card numbers its components
      integer  :: bolt = 0                   !! BOLT id, 0: none
      real(wp) :: area = 0.0_wp              !! of a bar [length^2]
      real(wp) :: strength = 0.0_wp          !! ST of its material, 0: not given [pressure]
      type(tightening_type) :: tightening    !! of a bolt; it is elastic between its stages and after them
      type(thread_type) :: thread            !! of a bolt, in the units of the deck
      real(wp) :: torsion = 0.0_wp           !! G J/L of a bar [force x length]
      real(wp) :: mass = 0.0_wp              !! (rho A + NSM) L of a bar [force x time^2/length]
      real(wp) :: expansion = 0.0_wp         !! alpha L [length/temperature]
      real(wp) :: reference = 0.0_wp         !! TREF [temperature]
      integer  :: column = 0                 !! in the temperatures of elements
      real(wp) :: damping = 0.0_wp           !! GE, structural damping [-]
      real(wp) :: viscous = 0.0_wp           !! B of a spring, viscous damping [force x time/length]
      integer, allocatable  :: of_matrix(:)  !! K2GG: nodes with a MATRIX between their components, components of node 1
      real(wp), allocatable :: matrix(:, :)  !! first; not allocated: the terms above [force/length]
   end type bar_type

   !> CONM2: a mass at a node. CMASS2: a mass that resists along one direction. CONM1, and a CMASS between two components: a MATRIX.
   type, public :: point_mass_type
      integer  :: node = 0
      real(wp) :: mass = 0.0_wp              !! [force x time^2/length]
      real(wp) :: directed(3, 3) = 0.0_wp    !! resists along some directions only [force x time^2/length]
      real(wp) :: inertia(3, 3) = 0.0_wp     !! about the node, in global axes; acts on rotations [force x time^2 x length]
      integer, allocatable  :: nodes(:)      !! with a MATRIX between their components, components of node 1 first; not
      real(wp), allocatable :: matrix(:, :)  !! allocated: the terms above [force x time^2/length]
   end type point_mass_type

   !> A pretension section, at which a solid bolt is cut. The nodes of the section move with the marked side. Elements behind the
   !! section have these nodes displaced by the overlap g along DIRECTION: u + g direction. g is component 1 of a separate node.
   type, public :: section_type
      integer  :: bolt = 0                   !! BOLT id
      integer  :: surface = 0                !! PMARK id
      integer  :: node = 0                   !! position of the node of g; its other components are held
      integer  :: point = 0                  !! a node of the section
      real(wp) :: direction(3) = 0.0_wp      !! unit, from the side behind to the marked side: g > 0 shortens the bolt
      real(wp) :: area = 0.0_wp              !! [length^2]
      real(wp) :: strength = 0.0_wp          !! ST of its material, 0: not given [pressure]
      type(tightening_type) :: tightening    !! g is held between its stages and after them
      type(thread_type) :: thread            !! in the units of the deck
   end type section_type

   !> The rotations of a node of shells or beams, or of a reference node, which moves with others as a rigid body. They are the
   !! components of a separate node: x, y, z in space, the first component (about z) in the plane. The unknown is the rotation times
   !! an arm, a displacement, so that all unknowns have one unit; the conjugate force is the moment divided by the arm.
   type, public :: rotation_type
      integer  :: point = 0                  !! the node
      integer  :: node = 0                   !! the node of its rotations
      real(wp) :: arm = 1.0_wp               !! root mean square of the distances of the dependent nodes, or of the nodes of
                                             !! the elements, from it [length]
      logical  :: of_element = .false.       !! whether it belongs to shells, beams or rods
      logical  :: of_rods = .false.          !! to rods alone
   end type rotation_type

   !> A node on the face of shells, at a rigid LEVER from POINT, a node of the shells; or the end of a CBUSH at its point.
   type, public :: face_node_type
      integer  :: point = 0
      integer  :: node = 0
      real(wp) :: lever(3) = 0.0_wp          !! [length]
   end type face_node_type

   !> A node that the deck defines by position: NODEAT, or the reference node of an RBE2M or RBE3M.
   type, public :: placed_node
      integer  :: id = 0                     !! of NODEAT; 0: a reference node
      integer  :: element = 0                !! the rigid element of a reference node; 0: NODEAT
      integer  :: surface = 0                !! PMARK, 0: none
      integer  :: node = 0
      integer  :: number = 0                 !! of the node, from the mesh or by the program
      real(wp) :: x(3) = 0.0_wp              !! the position that NODEAT gives [length]
   end type placed_node

   !> The source of a support: an SPC1 card, the SPC cards of one set, the SPCM card of a surface, or PS of GRID.
   type, public :: support_group
      character(4) :: kind = ''              !! SPC, SPC1, SPCM, GRID; FREE: supports added to a free structure
      integer :: id = 0                      !! SPCM: the PMARK; else the set; GRID: 0
      integer :: line = 0                    !! of the (first) card in the deck text
   end type support_group

   !> Nodes whose displacements are not their own unknowns in global axes, see node_coupling.
   type, public :: node_coupling_type
      integer :: n = 0                       !! number of coupled nodes
      integer, allocatable  :: of_node(:)    !! (n_nodes) position among the coupled nodes, 0: none; empty: none is coupled
      integer, allocatable  :: first(:)      !! (at least n + 1) parts first(k) to first(k + 1) - 1 are of coupled node k:
      integer, allocatable  :: node(:)       !! (at least parts) the unknowns of this node
      real(wp), allocatable :: t(:, :, :)    !! (dimension, dimension, likewise) by this matrix [-]
   end type node_coupling_type

   !> The table of unknowns, a list of nodes for each element, see element_unknowns.
   type, public :: unknowns_table
      integer, allocatable :: first(:)         !! (n_elements + 1) row e is node(first(e):first(e + 1) - 1)
      integer, allocatable :: first_unknown(:) !! (n_elements) position where the nodes of unknowns begin in the row
      integer, allocatable :: node(:)
   end type unknowns_table

   !> The mesh: points with duplicates, mid-side and face nodes, the nodes of rotations and of pretension sections; elements, properties,
   !! surfaces; bars, springs, masses.
   type, public :: mesh_type
      integer :: dimension = 2               !! degrees of freedom per node
      character(:), allocatable :: kind_words !! how a model in x-y without MODEL is read; not allocated: no choice
      logical :: axisymmetric = .false.      !! about y; loads, areas and forces are those of the whole ring
      integer :: n_nodes = 0
      integer :: n_filled = 0                !! number of mid-edge nodes that the program added, see node_build
      integer :: first_filled = 0            !! position of the first of these nodes
      integer, allocatable :: middles(:, :)  !! (5, n) mid-side nodes beside linear shells: place and element, ends of the edge, line
      integer, allocatable  :: node_id(:)    !! ascending until the model is built; 0 for the nodes of rotations and of sections, which follow
      real(wp), allocatable :: x(:, :)       !! (3, n_nodes) [length]
      integer, allocatable  :: duplicate(:)  !! (n_nodes) the duplicate of a node on a split surface, 0: none; empty before
      integer, allocatable  :: node_system(:) !! (n_nodes) the system CD of a node, 0: global axes; empty: no node has one
      type(placed_node), allocatable :: placed(:) !! nodes defined by position
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
      type(structural_type) :: structural        !! set if there are shells or beams
      type(surface_type), allocatable  :: surfaces(:)
      type(bar_type), allocatable          :: bars(:)
      type(point_mass_type), allocatable   :: masses(:)
      logical :: lumped = .false.            !! MASS = LUMPED: the masses of elements are lumped at their nodes
      type(section_type), allocatable      :: sections(:)
      type(rotation_type), allocatable     :: rotations(:)
      type(face_node_type), allocatable    :: faces(:)
      logical, allocatable  :: is_scalar(:)          !! (points of the deck) SPOINT, which has one component; empty: there are none
      integer, allocatable  :: face_of(:)            !! (points) position of a node in faces, 0: none; empty: there are none
      integer, allocatable  :: rotation_of(:)        !! (points) position of a node in rotations, 0: none; empty: there are none
      integer, allocatable  :: node_section(:)       !! (n_nodes) the section that contains a node, 0: none; empty: there are none
      integer, allocatable  :: element_section(:) !! (n_elements) the section that an element touches from behind, 0: none; or empty
   end type mesh_type

   !> The joints and their interface elements.
   type, public :: joints_type
      type(joint_type), allocatable :: list(:)
      type(interface_element), allocatable :: element(:) !! those of joint j are first to last of it
      type(interface_element), allocatable :: glue(:)    !! of glued surfaces: what they move relative to each other is zero
   end type joints_type

   !> What the unknowns of the nodes are: supported, dependent, coupled; the connected parts.
   type, public :: freedoms_type
      logical, allocatable  :: used(:)       !! (n_nodes) whether any element has the node
      logical, allocatable  :: held(:, :)    !! (dimension, n_nodes) supported unknowns
      type(support_group), allocatable :: support_groups(:)
      logical :: floats = .false.            !! the structure has no supports but those of FREE
      integer, allocatable  :: support_of(:, :) !! (dimension, nodes at that time) the first of the groups that supports it, 0: none
      logical, allocatable  :: left_out(:, :) !! (dimension, n_nodes) no unknown and no support: dependent components, or
                                             !! components of reference nodes that move nothing; held too; empty: there are none
      type(node_coupling_type) :: coupling   !! of displacements to unknowns
      type(unknowns_table) :: table          !! element -> nodes of its unknowns
      integer, allocatable  :: part(:)       !! (n_nodes) the connected body of a node
      integer :: n_parts = 0
   end type freedoms_type

   !> The load history: the loads at the end of every stage.
   type, public :: history_type
      type(stage_load_type), allocatable :: stages(:)
   end type history_type

   !> The model, in parts.
   type, public :: model_type
      type(mesh_type)     :: mesh
      type(joints_type)   :: joints
      type(freedoms_type) :: freedoms
      type(freedoms_type), allocatable :: sets(:) !! of the stages, where SPC or MPC differ; FREEDOMS is the one in force
      integer :: supports = 1                !! its position
      real(wp), allocatable :: rigid(:, :, :), mean(:, :, :) !! (dimension, n_nodes, motions) of inertia_relief
      type(history_type)  :: history
      type(text_item), allocatable :: warnings(:) !! about the model, found while it was built
   end type model_type

contains

   !> Whether STAGE tightens the bolt.
   pure logical function is_in(self, stage)
      class(tightening_type), intent(in) :: self
      integer, intent(in)                :: stage

      is_in = allocated(self%stage)
      if (is_in) is_in = any(self%stage == stage)
   end function is_in

   !> The preload at the end of STAGE; 0 where this stage does not tighten the bolt.
   pure real(wp) function preload_in(self, stage) result(preload)
      class(tightening_type), intent(in) :: self
      integer, intent(in)                :: stage

      preload = 0.0_wp
      if (self%is_in(stage)) preload = self%preload(findloc(self%stage, stage, dim=1))
   end function preload_in

   !> The last stage until STAGE that tightens the bolt, 0: none.
   pure integer function last_until(self, stage) result(last)
      class(tightening_type), intent(in) :: self
      integer, intent(in)                :: stage

      last = 0
      if (allocated(self%stage)) last = max(0, maxval(self%stage, mask=self%stage <= stage))
   end function last_until

   !> The number of bars.
   pure integer function n_bars(mesh)
      type(mesh_type), intent(in) :: mesh

      n_bars = size(mesh%bars)
   end function n_bars

   !> The nodes of BAR, without the ground.
   pure function bar_nodes(bar) result(nodes)
      type(bar_type), intent(in) :: bar
      integer, allocatable :: nodes(:)

      nodes = pack(bar%nodes, bar%nodes > 0)
      if (allocated(bar%of_matrix)) nodes = bar%of_matrix
   end function bar_nodes

   !> The bars with viscous damping.
   pure function damped_bars(mesh) result(bars)
      type(mesh_type), intent(in) :: mesh
      integer, allocatable :: bars(:)
      integer :: i

      bars = pack([(i, i = 1, n_bars(mesh))], mesh%bars%viscous > 0.0_wp)
   end function damped_bars

   !> The number of pretension sections.
   pure integer function n_sections(mesh)
      type(mesh_type), intent(in) :: mesh

      n_sections = size(mesh%sections)
   end function n_sections

   !> The components of NODE that are supported.
   pure function supported(mesh, freedoms, node) result(held)
      type(mesh_type), intent(in) :: mesh
      type(freedoms_type), intent(in) :: freedoms
      integer, intent(in)          :: node
      logical :: held(mesh%dimension)

      held = freedoms%held(:, node)
      if (size(freedoms%left_out) > 0) held = held .and. .not. freedoms%left_out(:, node)
   end function supported

   !> The number of the node that interface element I names for END 1 or 2: 0 for a rigid base, -1 where the end has several nodes.
   pure integer function joint_node_id(model, i, end) result(id)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: i, end

      id = named_node(model%joints%element(i), end)
      if (id > 0) id = model%mesh%node_id(id)
   end function joint_node_id

end module model_data
