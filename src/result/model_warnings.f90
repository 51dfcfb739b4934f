!> What a model itself is warned of, before it is solved.
module model_warnings
   use element_kinds, only: kind_tetra4
   use model_data, only: model_type
   implicit none
   private

   public :: tetra_words

contains

   !> What to say of a model whose bodies are of linear tetrahedra alone; empty of any other.
   pure function tetra_words(model) result(words)
      type(model_type), intent(in) :: model
      character(:), allocatable    :: words

      words = ''
      if (model%n_elements > 0 .and. all(model%element_kind == kind_tetra4)) words = 'all bodies are of linear '// &
         'tetrahedra, 10 to 35 % too stiff in bending on usual meshes: mesh with second order'
   end function tetra_words

end module model_warnings
