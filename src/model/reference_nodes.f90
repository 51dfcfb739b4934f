!> Reference nodes of rigid elements: the node that their rotations have for themselves, and the axes along which a node's components
!! are counted.
module reference_nodes
   use coordinate_systems, only: directions_at
   use kinds, only: wp
   use model_data, only: model_type
   implicit none
   private

   public :: rotation_at, rotation_component, node_axes, place_of_component, third_axis

   !> A component of a node as unknowns count them: component D of NODE, times SCALE.
   type, public :: component_place
      integer  :: node = 0       !! 0: there is none
      integer  :: d = 0
      real(wp) :: scale = 1.0_wp !! the displacement kept there by the component: 1, of a rotation its arm
   end type component_place

contains

   !> Which of the rotations of MODEL are those of POINT; 0: it has none.
   pure integer function rotation_at(model, point) result(rotation)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: point

      rotation = 0
      if (.not. allocated(model%rotation_of)) return
      if (point <= size(model%rotation_of)) rotation = model%rotation_of(point)
   end function rotation_at

   !> Where the rotation that NASTRAN calls component DIGIT, 4 to 6, stands among those of a node of rotations; 0: nowhere, in the
   !! plane.
   pure integer function rotation_component(model, digit) result(d)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: digit

      d = digit - 3
      if (model%dimension == 2) d = merge(1, 0, digit == 6)
   end function rotation_component

   !> Component DIGIT, 1 to 6, of POINT.
   pure function place_of_component(model, point, digit) result(place)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: point, digit
      type(component_place) :: place
      integer :: rotation

      if (digit <= 3) then
         if (digit <= model%dimension) place = component_place(point, digit, 1.0_wp)
         return
      end if
      rotation = rotation_at(model, point)
      if (rotation == 0 .or. rotation_component(model, digit) == 0) return
      place = component_place(model%rotations(rotation)%node, rotation_component(model, digit), model%rotations(rotation)%arm)
      if (model%dimension == 2) place%scale = place%scale*sum(third_axis(model, point)) ! z is one way or the other
   end function place_of_component

   !> The third direction of NODE of a plane model, along z or against it.
   pure function third_axis(model, node) result(axis)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp) :: axis(3), axes(3, 3)

      axes = node_axes(model, node)
      axis = [0.0_wp, 0.0_wp, sign(1.0_wp, axes(3, 3))]
   end function third_axis

   !> The directions of the components of NODE in global axes, columns: those of its system CD.
   pure function node_axes(model, node) result(axes)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      real(wp) :: axes(3, 3)
      logical  :: ok

      axes = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      if (.not. allocated(model%node_system)) return
      if (model%node_system(node) > 0) call directions_at(model%systems(model%node_system(node)), model%x(:, node), axes, ok)
   end function node_axes

end module reference_nodes
