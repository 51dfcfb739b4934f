!> The values of the bodies at the end of a stage: the largest displacement of a node, and the largest von Mises stress at the centre
!! of an element and at a node as the mean of its elements.
module body_values
   use analysis_state, only: analysis_type
   use body_elements, only: element_centre, node_stresses, whole_stress
   use elasticity, only: max_stresses, von_mises
   use kinds, only: wp
   use mesh_queries, only: n_points
   use model_data, only: model_type
   use numbers, only: first_largest, is_measure
   use structural_results, only: node_peaks
   use text_tools, only: integer_text
   implicit none
   private

   public :: find_body_values, fault_of_bodies

   !> The largest value of a kind, and its place.
   type, public :: peak_type
      logical  :: is_there = .false.
      real(wp) :: value = 0.0_wp
      integer  :: id = 0                       !! of a node, or of an element
      real(wp) :: x(3) = 0.0_wp                !! position [length]
   end type peak_type

   type, public :: body_values_type
      type(peak_type) :: displacement          !! magnitude [length]
      type(peak_type) :: at_centre, at_node    !! von Mises [pressure]
      real(wp) :: strained = 0.0_wp            !! largest von Mises stress at the centre of an element over its E
   end type body_values_type

contains

   !> The values at the end of the stage just completed, the bodies recovered.
   subroutine find_body_values(model, analysis, answer)
      type(model_type), intent(in)        :: model
      type(analysis_type), intent(in)     :: analysis
      type(body_values_type), intent(out) :: answer
      real(wp), allocatable :: at_node(:, :), size_of(:), structural(:), at_ends(:)
      integer :: e, node

      ! the largest displacement
      allocate (size_of(n_points(model%mesh)))
      do node = 1, size(size_of)
         size_of(node) = norm2(analysis%all_u(:, node))
      end do
      node = first_largest(size_of, model%freedoms%used(:size(size_of)))
      if (node > 0) answer%displacement = peak_type(.true., maxval(size_of, mask=model%freedoms%used(:size(size_of))), &
                                                    model%mesh%node_id(node), model%mesh%x(:, node))
      if (model%mesh%n_elements == 0) return

      ! the largest von Mises stress at a node
      allocate (at_node(max_stresses, n_points(model%mesh)))
      call node_stresses(model, analysis%all_u, analysis%now%temperature, at_node)
      allocate (structural(size(size_of)), at_ends(model%mesh%n_elements))
      call node_peaks(model, analysis%all_u, analysis%now%temperature, structural, at_ends, analysis)
      do node = 1, size(size_of)
         size_of(node) = max(von_mises(at_node(:, node)), structural(node))
      end do
      node = first_largest(size_of, model%freedoms%used(:size(size_of)))
      answer%at_node = peak_type(.true., largest(size_of), model%mesh%node_id(node), model%mesh%x(:, node))

      ! that at the centre of an element
      deallocate (size_of)
      allocate (size_of(model%mesh%n_elements))
      !$omp parallel do schedule(dynamic, 512) default(shared) if(model%mesh%n_elements > 4096)
      do e = 1, model%mesh%n_elements
         size_of(e) = max(von_mises(whole_stress(model, e, analysis%all_u, analysis%now%temperature)), at_ends(e))
      end do
      !$omp end parallel do
      associate (modulus => model%mesh%properties(model%mesh%element_property)%e)
         if (all(is_measure(size_of))) answer%strained = maxval(size_of/modulus, mask=modulus > 0.0_wp)
      end associate
      e = first_largest(size_of, size_of >= 0.0_wp)
      answer%at_centre = peak_type(.true., largest(size_of), model%mesh%element_id(e))
      answer%at_centre%x(:model%mesh%dimension) = element_centre(model, e)
   end subroutine find_body_values

   !> The largest of VALUES, or the first one that is not a number.
   pure real(wp) function largest(values)
      real(wp), intent(in) :: values(:)

      largest = maxval(values)
      if (.not. all(is_measure(values))) largest = values(findloc(is_measure(values), .false., dim=1))
   end function largest

   !> What of VALUES is beyond all bounds, '': nothing.
   pure function fault_of_bodies(values) result(words)
      type(body_values_type), intent(in) :: values
      character(:), allocatable :: words

      words = ''
      if (.not. is_measure(values%displacement%value)) then
         words = 'the displacement of node '//integer_text(values%displacement%id)
      else if (.not. is_measure(values%at_centre%value)) then
         words = 'the stress of element '//integer_text(values%at_centre%id)
      else if (.not. is_measure(values%at_node%value)) then
         words = 'the stress at node '//integer_text(values%at_node%id)
      end if
   end function fault_of_bodies

end module body_values
