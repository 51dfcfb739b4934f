!> The unknowns of a node: their places among components 1 to 6, their names in messages, their values in a rigid-body motion.
!! The unknowns of a point are its displacements, along global axes or along its system CD. Those of a node of rotations are the
!! rotation times its arm. A pretension section does not open in a rigid-body motion.
module unknowns
   use coordinate_systems, only: directions_at
   use kinds, only: wp
   use mesh_queries, only: is_scalar_point, node_kind, place_in_kind, point_of
   use model_data, only: a_point, a_rotation, an_overlap, mesh_type, model_type
   use numbers, only: cross, identity
   use text_tools, only: integer_text, one_of
   implicit none
   private

   public :: what_is_loose, unknown_name, n_motions, motions_of, motions_at, rotation_at, rotation_component, &
             place_of_component, component_axes, node_axes, third_axis

   !> The place of a nodal component among the unknowns: component D of NODE, times SCALE.
   type, public :: component_place
      integer  :: node = 0       !! 0: the component does not exist
      integer  :: d = 0
      real(wp) :: scale = 1.0_wp !! the stored displacement by the component: 1, for a rotation its arm
   end type component_place

contains

   !> Words that the unknown in direction D of NODE has no stiffness; NODE may be a node of rotations or a pretension section.
   pure function what_is_loose(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: direction, owner, words

      call name_unknown(model, node, d, owner, direction)
      if (direction == '') then
         words = 'no stiffness holds '//owner//' together at its section'
      else
         words = owner//' has no stiffness '// &
                 one_of(node_kind(model%mesh, node) == a_rotation, 'against', 'in')//' '//direction
      end if
   end function what_is_loose

   !> The same unknown, named as a place.
   pure function unknown_name(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: direction, owner, words

      call name_unknown(model, node, d, owner, direction)
      words = owner//' in '//direction
      if (direction == '') words = 'the section of '//owner
   end function unknown_name

   !> OWNER: 'node 7', or for a pretension section 'BOLT 3'. DIRECTION: 'direction X', or with a system CD 'direction 1 of its
   !! system 7'; for a node of rotations 'rotation about X', in the plane about Z only; '' for a pretension section.
   pure subroutine name_unknown(model, node, d, owner, direction)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable, intent(out) :: owner, direction
      character(1), parameter :: letters(3) = ['X', 'Y', 'Z']
      integer :: point, system
      logical :: is_rotation

      direction = ''
      if (node_kind(model%mesh, node) == an_overlap) then
         owner = 'BOLT '//integer_text(model%mesh%sections(place_in_kind(model%mesh, node))%bolt)
         return
      end if
      is_rotation = node_kind(model%mesh, node) == a_rotation
      point = point_of(model%mesh, node)
      owner = 'node '//integer_text(model%mesh%node_id(point))
      system = 0
      if (size(model%mesh%node_system) > 0) system = model%mesh%node_system(point)
      direction = letters(merge(3, d, is_rotation .and. model%mesh%dimension == 2))
      if (.not. is_rotation) direction = 'direction '//direction
      if (system > 0) direction = 'direction '//integer_text(d)//' of its system '//integer_text(model%mesh%systems(system)%id)
      if (is_rotation) direction = 'rotation about '//direction
   end subroutine name_unknown

   !> Number of rigid-body motions, three in the plane, six in space: along the axes, then about them.
   pure integer function n_motions(dimension)
      integer, intent(in) :: dimension

      n_motions = merge(6, 3, dimension == 3)
   end function n_motions

   !> Displacements of a point at X: (dimension, motions).
   pure function motions_at(x) result(u)
      real(wp), intent(in) :: x(:) !! (dimension) [length]
      real(wp) :: u(size(x), n_motions(size(x)))
      integer  :: c, d

      d = size(x)
      u = 0.0_wp
      do c = 1, d
         u(c, c) = 1.0_wp
      end do
      if (d == 2) then
         u(:, 3) = [-x(2), x(1)]
      else
         do c = 1, 3
            u(:, 3 + c) = cross(u(:, c), x)
         end do
      end if
   end function motions_at

   !> Unknowns of NODE: (dimension, motions).
   pure function motions_of(model, node) result(q)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp) :: q(model%mesh%dimension, n_motions(model%mesh%dimension)), axes(3, 3)
      integer  :: d

      d = model%mesh%dimension
      q = 0.0_wp
      select case (node_kind(model%mesh, node))
      case (a_point)
         if (is_scalar_point(model%mesh, node)) return
         axes = node_axes(model%mesh, node)
         q = matmul(transpose(axes(:d, :d)), motions_at(model%mesh%x(:d, node)))
      case (a_rotation)
         associate (arm => model%mesh%rotations(place_in_kind(model%mesh, node))%arm)
            if (d == 2) then
               q(rotation_component(model%mesh, 6), 3) = arm ! about z, whatever the system CD
            else
               q(:, 4:) = arm*transpose(node_axes(model%mesh, point_of(model%mesh, node)))
            end if
         end associate
      end select
   end function motions_of

   !> The position of POINT in the rotations of the model; 0: it has none.
   pure integer function rotation_at(mesh, point) result(rotation)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: point

      rotation = 0
      if (point <= size(mesh%rotation_of)) rotation = mesh%rotation_of(point)
   end function rotation_at

   !> The position of rotation DIGIT, 4 to 6 in NASTRAN, among the components of a node of rotations; 0: it does not exist in the
   !! plane.
   pure integer function rotation_component(mesh, digit) result(d)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: digit

      d = digit - 3
      if (mesh%dimension == 2) d = merge(1, 0, digit == 6)
   end function rotation_component

   !> The place of component DIGIT, 1 to 6, of POINT; of a scalar point 0 or 1.
   pure function place_of_component(mesh, point, digit) result(place)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: point, digit
      type(component_place) :: place
      integer :: rotation

      if (is_scalar_point(mesh, point)) then
         if (digit <= 1) place = component_place(point, 1, 1.0_wp)
         return
      end if
      if (digit <= 3) then
         if (digit <= mesh%dimension .and. digit > 0) place = component_place(point, digit, 1.0_wp)
         return
      end if
      rotation = rotation_at(mesh, point)
      if (rotation == 0 .or. rotation_component(mesh, digit) == 0) return
      place = component_place(mesh%rotations(rotation)%node, rotation_component(mesh, digit), mesh%rotations(rotation)%arm)
      ! the z axis of the node may point along -z
      if (mesh%dimension == 2) place%scale = place%scale*sum(third_axis(mesh, point))
   end function place_of_component

   !> The third direction of NODE of a plane model, along z or -z.
   pure function third_axis(mesh, node) result(axis)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node
      real(wp) :: axis(3), axes(3, 3)

      axes = node_axes(mesh, node)
      axis = [0.0_wp, 0.0_wp, sign(1.0_wp, axes(3, 3))]
   end function third_axis

   !> The directions of the components of NODE in global axes, columns: those of its system CD.
   pure function node_axes(mesh, node) result(axes)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)          :: node
      real(wp) :: axes(3, 3)
      logical  :: ok

      axes = identity
      if (size(mesh%node_system) == 0) return
      if (mesh%node_system(node) > 0) call directions_at(mesh%systems(mesh%node_system(node)), mesh%x(:, node), axes, ok)
   end function node_axes

   !> The directions of the components of NODE, which may be one of rotations, in global axes, columns.
   pure function component_axes(mesh, node) result(axes)
      type(mesh_type), intent(in) :: mesh
      integer, intent(in)         :: node
      real(wp) :: axes(mesh%dimension, mesh%dimension), whole(3, 3)

      whole = identity ! of an overlap too, and of a rotation in the plane, about z in the first column
      if (node_kind(mesh, node) == a_point) whole = node_axes(mesh, node)
      if (node_kind(mesh, node) == a_rotation .and. mesh%dimension == 3) whole = node_axes(mesh, point_of(mesh, node))
      axes = whole(:mesh%dimension, :mesh%dimension)
   end function component_axes

end module unknowns
