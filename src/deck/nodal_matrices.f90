!> Matrices between components of nodes: what the cards DMIG say, and the components that ASET and QSET name.
module nodal_matrices
   use card_fields, only: id_ranges
   use kinds, only: wp
   implicit none
   private

   !> DMIG: the header of a matrix, whose FORM is above 0, or terms of one of its columns.
   type, public :: dmig_card
      integer  :: line = 0
      character(8) :: name = ''
      integer  :: form = 0                         !! 1: square, all terms are given; 6: symmetric, one of two equal terms
      integer  :: node = 0, component = 0          !! of the column; component 0: that of an SPOINT
      integer, allocatable  :: nodes(:), components(:), at(:) !! of the rows; AT: data field of the node
      real(wp), allocatable :: values(:)
   end type dmig_card

   !> ASET, ASET1, BSET, BSET1: COMPONENTS of nodes that are retained; QSET, QSET1: coordinates of modes.
   type, public :: retained_card
      integer :: line = 0, components = 0
      logical :: of_modes = .false.
      type(id_ranges) :: nodes
   end type retained_card

   !> These cards of a deck.
   type, public :: matrix_cards_type
      type(dmig_card), allocatable     :: dmig(:)
      type(retained_card), allocatable :: retained(:)
   end type matrix_cards_type

end module nodal_matrices
