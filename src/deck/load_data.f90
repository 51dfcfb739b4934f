!> What the cards of loads say: forces, pressures, accelerations, temperatures, prescribed displacements; bolts, and the regions and pairs
!! of contact of NX. One type for each kind of card, as bulk_data stores it.
module load_data
   use bolt_threads, only: thread_type
   use card_fields, only: id_ranges
   use kinds, only: wp
   implicit none
   private

   !> FORCE (a vector), FORCE1 (a force from node ENDS(1) to ENDS(2)), FORCE2 (normal to two such lines), and MOMENT likewise.
   type, public :: force_card
      integer  :: line = 0, set = 0, node = 0
      integer  :: system = 0                            ! CID of the vector, 0: global axes
      integer  :: ends(4) = 0                           ! 0: given by the vector
      real(wp) :: force(3) = 0.0_wp                     ! FORCE1, FORCE2: the first component is the force
      logical  :: is_moment = .false.
   end type force_card

   integer, parameter, public :: of_edge = 1, of_face = 2, of_nodes = 3, of_marks = 4 !! kinds of pressure card, by the entity named

   !> PLOADE: the edge of element FIRST between its corners G1 and G2. PLOAD4: the face of element FIRST at G1 and G3 or G4, or the
   !! faces marked by the elements FIRST to LAST. PLOAD2: the faces marked by the elements in RANGES. PLOAD: the face at CORNERS.
   type, public :: pressure_card
      integer  :: line = 0, set = 0, first = 0, last = 0, kind = of_edge, corners(4) = 0
      type(id_ranges) :: ranges
      real(wp) :: pressure(4) = 0.0_wp                  ! positive into the body, at the corners from G1
      integer  :: system = 0                            ! CID of the direction, 0: global axes
      real(wp) :: direction(3) = 0.0_wp                 ! of PLOAD4; zero: along the normal
   end type pressure_card

   !> PLOADM and FORCEM: pressure, or an evenly distributed total force, on a marked surface.
   type, public :: surface_load_card
      integer  :: line = 0, set = 0, surface = 0
      logical  :: is_pressure = .false.                 ! PLOADM
      real(wp) :: pressure = 0.0_wp, force(3) = 0.0_wp
   end type surface_load_card

   !> GRAV, ACCEL1: acceleration; RFORCE: rotation.
   type, public :: gravity_card
      integer  :: line = 0, set = 0
      integer  :: system = 0                            ! CID, 0: global axes
      real(wp) :: acceleration(3) = 0.0_wp
      logical  :: is_spin = .false.                     ! RFORCE
      integer  :: node = 0                              ! on the axis, 0: the origin
      real(wp) :: spin(3) = 0.0_wp                      ! angular velocity [rad/time]
      real(wp) :: spin_rate(3) = 0.0_wp                 ! angular acceleration [rad/time^2]
      type(id_ranges) :: nodes                          ! of ACCEL1: acts on the masses of these nodes; not allocated: on all
   end type gravity_card

   !> SPCD: a displacement prescribed at a held component, in a load set.
   type, public :: displacement_card
      integer  :: line = 0, set = 0, node = 0, components = 0
      integer  :: field = 0                             ! data field of the node
      real(wp) :: value = 0.0_wp
   end type displacement_card

   !> TEMP: the temperature of a node. TEMPD: the temperature of all nodes without a TEMP.
   type, public :: temperature_card
      integer  :: line = 0, set = 0
      logical  :: is_default = .false.                  ! TEMPD
      integer  :: node = 0                              ! of a TEMP
      integer  :: field = 0                             ! data field of the node, for a TEMPD of the set
      real(wp) :: value = 0.0_wp
   end type temperature_card

   !> TEMPP1: the MEAN temperature over the thickness of shells, and its gradient along the normal. TEMPRB: that over the section of
   !! beams and rods at their ends A and B, and its gradients, along y at A and B, along z at A and B.
   type, public :: own_temperature_card
      integer  :: line = 0, set = 0
      logical  :: is_plate = .false.                    ! TEMPP1
      type(id_ranges) :: ranges                         ! of elements
      real(wp) :: mean(2) = 0.0_wp, slope(4) = 0.0_wp   ! TEMPP1: slope(1)
   end type own_temperature_card

   !> BOLT: the CROD ELEMENT, or a solid cut at the marked SURFACE, tightened to PRELOAD in SUBCASE STAGE and locked afterwards.
   type, public :: bolt_card
      integer  :: line = 0, id = 0, element = 0, stage = 0, surface = 0
      real(wp) :: preload = 0.0_wp
      type(thread_type) :: thread                       ! in mm and N
      integer  :: kind = 0                              ! ETYPE of a BOLT of NX, 0: of this program; negative: a copy
      type(id_ranges) :: parts                          ! of NX: elements (1, 3) or nodes of its section (2)
      integer  :: system = 0, axis = 0, node = 0        ! of NX: CSID, IDIR, GP
   end type bolt_card

   !> BSURF, BSURFS, BCPROP, BCPROPS: a region of contact or glue, which becomes the marked SURFACE; BCRPARA: its side.
   type, public :: region_card
      integer :: line = 0, id = 0, surface = 0          ! SURFACE 0: no active pair has it
      logical :: by_property = .false.                  ! RANGES are properties
      logical :: is_parameter = .false., is_bottom = .false. ! BCRPARA; the faces of shells against their normals
      type(id_ranges) :: ranges                         ! of elements
      integer, allocatable :: corners(:, :)             ! (3, ranges) of the face of a BSURFS; not allocated: all free faces
   end type region_card

   !> BCTSET, BGSET: pairs of regions in contact or glued.
   type, public :: pair_card
      integer :: line = 0, set = 0
      logical :: is_glue = .false.
      integer, allocatable  :: regions(:, :)            ! (2, pairs) SID, TID
      real(wp), allocatable :: mu(:), reach(:)          ! FRIC; MAXD or SDIST, 0: blank
   end type pair_card

   !> BOLTFOR: the preload of bolts of NX; BOLTSEQ: an order of sets of preloads.
   type, public :: preload_card
      integer  :: line = 0, set = 0
      real(wp) :: force = 0.0_wp
      type(id_ranges) :: bolts
      integer, allocatable :: order(:), sets(:)         ! of BOLTSEQ; not allocated: BOLTFOR
   end type preload_card

   type, public :: load_card
      integer  :: line = 0, set = 0
      real(wp) :: scale = 0.0_wp
      real(wp), allocatable :: factors(:)
      integer, allocatable  :: sets(:), at(:)           ! AT(k): data field of SETS(k)
   end type load_card

end module load_data
