!> Submodels: some elements of a model with nodes numbered anew, and the pieces in which the bodies are written.
!! Each element is shown in one piece.
module body_parts
   use element_unknowns, only: displaced_nodes
   use lists, only: list_owners
   use mesh_queries, only: element_points, n_points, start_parts
   use model_data, only: model_type, n_sections
   use temperatures, only: has_temperatures
   implicit none
   private

   public :: extract, nodes_of_elements, all_shown, cut_piece

   !> The part of a model that is shown.
   type, public :: shown_type
      integer :: n_points = 0                 !! number of shown nodes, which come first
      integer, allocatable :: elements(:)     !! ascending
      logical :: is_warm = .false. !! with temperatures
   end type shown_type

   !> A piece: a model of the shown elements and of all other elements at the shown nodes, so that nodal means equal those of the
   !! whole structure. The model contains elements, nodes, properties, sections and the connectivity.
   type, public :: body_piece_type
      type(model_type) :: model
      type(shown_type) :: shown
   end type body_piece_type

contains

   !> All bodies of MODEL.
   pure function all_shown(model) result(shown)
      type(model_type), intent(in) :: model
      type(shown_type) :: shown
      integer :: e

      shown%n_points = n_points(model%mesh)
      allocate (shown%elements, source=[(e, e = 1, model%mesh%n_elements)])
      shown%is_warm = has_temperatures(model)
   end function all_shown

   !> PART: these ELEMENTS of MODEL on these NODES, which must include all of theirs; only kinds, properties and coordinates are
   !! set.
   pure subroutine extract(model, elements, nodes, part)
      type(model_type), intent(in)  :: model
      integer, intent(in)           :: elements(:), nodes(:)
      type(model_type), intent(out) :: part
      integer, allocatable :: place(:)
      integer :: e, i

      allocate (place(0:model%mesh%n_nodes), source=0)
      place(nodes) = [(i, i = 1, size(nodes))]
      call start_parts(part)
      part%mesh%dimension = model%mesh%dimension
      part%mesh%properties = model%mesh%properties
      part%mesh%n_elements = size(elements)
      part%mesh%element_kind = model%mesh%element_kind(elements)
      part%mesh%element_property = model%mesh%element_property(elements)
      part%mesh%element_nodes = model%mesh%element_nodes(:, elements)
      do e = 1, part%mesh%n_elements
         part%mesh%element_nodes(:, e) = place(part%mesh%element_nodes(:, e)) ! 0 stays 0
      end do
      part%mesh%n_nodes = size(nodes)
      part%mesh%x = model%mesh%x(:, nodes)
   end subroutine extract

   !> The nodes of these ELEMENTS, ascending.
   pure function nodes_of_elements(model, elements) result(nodes)
      type(model_type), intent(in) :: model
      integer, intent(in)          :: elements(:)
      integer, allocatable :: nodes(:)
      logical :: has(model%mesh%n_nodes)
      integer :: i, k

      has = .false.
      do k = 1, size(elements)
         has(element_points(model%mesh, elements(k))) = .true.
      end do
      nodes = pack([(i, i = 1, model%mesh%n_nodes)], has)
   end function nodes_of_elements

   !> The PIECE number R: the elements whose first node belongs to part R, and the points of this part without elements. NODES are
   !! its nodes in the numbering of MODEL, shown nodes first. Elements and points of no part belong to piece 0.
   pure subroutine cut_piece(model, owner, r, piece, nodes)
      type(model_type), intent(in)       :: model
      integer, intent(in)                :: owner(:) !! (n_nodes) the part of each node, from 0 on; -1: none
      integer, intent(in)                :: r
      type(body_piece_type), intent(out) :: piece
      integer, allocatable, intent(out)  :: nodes(:)
      logical, allocatable :: is_shown(:), is_own(:), is_needed(:), is_part(:)
      integer, allocatable :: elements(:)
      integer :: e, i

      allocate (is_own(model%mesh%n_elements), is_part(model%mesh%n_elements))
      allocate (is_shown(model%mesh%n_nodes), is_needed(model%mesh%n_nodes), source=.false.)
      do e = 1, model%mesh%n_elements
         is_own(e) = max(owner(model%mesh%element_nodes(1, e)), 0) == r
         if (is_own(e)) is_shown(element_points(model%mesh, e)) = .true.
      end do
      do i = 1, n_points(model%mesh)
         if (model%mesh%first_at(i + 1) == model%mesh%first_at(i)) is_shown(i) = max(owner(i), 0) == r
      end do
      is_part = is_own
      do i = 1, model%mesh%n_nodes
         if (is_shown(i)) is_part(model%mesh%elements_at(model%mesh%first_at(i):model%mesh%first_at(i + 1) - 1)) = .true.
      end do
      elements = pack([(e, e = 1, model%mesh%n_elements)], is_part)
      do e = 1, size(elements)
         is_needed(displaced_nodes(model%freedoms, elements(e))) = .true.
      end do
      nodes = [pack([(i, i = 1, model%mesh%n_nodes)], is_shown), pack([(i, i = 1, model%mesh%n_nodes)], is_needed &
         .and. .not. is_shown)]
      call extract(model, elements, nodes, piece%model)
      associate (part => piece%model)
         part%mesh%node_id = model%mesh%node_id(nodes)
         part%mesh%element_id = model%mesh%element_id(elements)
         call list_owners(part%mesh%n_nodes, part%mesh%element_nodes, part%mesh%first_at, part%mesh%elements_at)
         if (n_sections(model%mesh) > 0) then
            part%mesh%element_section = model%mesh%element_section(elements)
            part%mesh%node_section = model%mesh%node_section(nodes)
            part%mesh%sections = model%mesh%sections
            do i = 1, size(part%mesh%sections) ! a section without elements in PART has no node in PART
               part%mesh%sections(i)%node = findloc(nodes, model%mesh%sections(i)%node, dim=1)
            end do
         end if
      end associate
      piece%shown%n_points = count(is_shown)
      piece%shown%elements = pack([(e, e = 1, size(elements))], is_own(elements))
      piece%shown%is_warm = has_temperatures(model)
   end subroutine cut_piece

end module body_parts
