!> The unknowns of the equations in words, for messages.
module unknown_names
   use model_data, only: model_type, n_points, n_rotations
   use text_tools, only: integer_text
   implicit none
   private

   public :: what_is_loose, unknown_name

contains

   !> That the unknown in direction D of NODE, which may be the rotations of a node or the section of a bolt, has no stiffness.
   pure function what_is_loose(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: words

      if (is_section(model, node)) then
         words = 'nothing holds BOLT '//bolt_number(model, node)//' together at its section'
      else if (is_rotation(model, node)) then
         words = 'node '//node_number(model, node)//' has no stiffness against rotation about '//axis_name(model, node, d)
      else
         words = 'node '//node_number(model, node)//' has no stiffness in '//direction_name(model, node, d)
      end if
   end function what_is_loose

   !> The same unknown, as a place that something is at.
   pure function unknown_name(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: words

      if (is_section(model, node)) then
         words = 'the section of BOLT '//bolt_number(model, node)
      else if (is_rotation(model, node)) then
         words = 'node '//node_number(model, node)//' in rotation about '//axis_name(model, node, d)
      else
         words = 'node '//node_number(model, node)//' in '//direction_name(model, node, d)
      end if
   end function unknown_name

   pure logical function is_section(model, node)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      is_section = node > n_points(model) + n_rotations(model)
   end function is_section

   pure logical function is_rotation(model, node)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      is_rotation = node > n_points(model) .and. .not. is_section(model, node)
   end function is_rotation

   !> The point whose displacements or rotations stand in NODE.
   pure integer function point_of(model, node) result(point)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node

      point = node
      if (is_rotation(model, node)) point = model%rotations(node - n_points(model))%point
   end function point_of

   pure function node_number(model, node) result(number)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      character(:), allocatable    :: number

      number = integer_text(model%node_id(point_of(model, node)))
   end function node_number

   pure function bolt_number(model, node) result(number)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node
      character(:), allocatable    :: number

      number = integer_text(model%sections(node - n_points(model) - n_rotations(model))%bolt)
   end function bolt_number

   !> 'direction X', or that of the system that the node has.
   pure function direction_name(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: words

      words = axis_name(model, node, d)
      if (len(words) == 1) words = 'direction '//words
   end function direction_name

   !> 'X', or 'direction 1 of its system 7'; in the plane the only rotation is about Z.
   pure function axis_name(model, node, d) result(words)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: node, d
      character(:), allocatable    :: words
      character(1), parameter :: letters(3) = ['X', 'Y', 'Z']

      words = letters(d)
      if (is_rotation(model, node) .and. model%dimension == 2) words = letters(3)
      if (.not. allocated(model%node_system)) return
      associate (system => model%node_system(point_of(model, node)))
         if (system > 0) words = 'direction '//integer_text(d)//' of its system '//integer_text(model%systems(system)%id)
      end associate
   end function axis_name

end module unknown_names
