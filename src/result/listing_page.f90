!> The page of the listing: its width, headings, units of its columns, and what every table says the same way.
module listing_page
   use analysis_state, only: analysis_type
   use case_control, only: case_control_type
   use kinds, only: wp
   use output_file, only: output_file_type
   use stage_plan, only: stage_plan_type
   use text_tools, only: integer_text
   implicit none
   private

   public :: heading, cut, unit_labels, in_units, in_column, where_now

   integer, parameter, public :: page_width = 132
   real(wp), parameter, public :: noise = 1.0e-9_wp !! of the largest number of its kind: below it only rounding is printed

   !> What the numbers of the listing are measured in, blank where the deck does not say.
   type, public :: label_type
      character(20) :: length = '', force = '', pressure = '', area = '', stiffness = ''
   end type label_type

contains

   !> A heading of a table, with an empty line before it.
   subroutine heading(file, words)
      type(output_file_type), intent(inout) :: file
      character(*), intent(in)              :: words

      call file%put('')
      call file%put(' '//cut(words, page_width - 1))
      call file%put('')
   end subroutine heading


   !> At most WIDTH characters of LINE, tabs and other controls as blanks.
   pure function cut(line, width) result(part)
      character(*), intent(in)  :: line
      integer, intent(in)       :: width
      character(:), allocatable :: part
      integer :: i

      part = line(:min(len(line), width))
      if (len(line) > width) part(width - 2:) = '...'
      do i = 1, len(part)
         if (iachar(part(i:i)) < 32) part(i:i) = ' '
      end do
   end function cut


   !> Labels out of UNITS = length, force.
   pure function unit_labels(control) result(labels)
      type(case_control_type), intent(in) :: control
      type(label_type) :: labels

      if (control%length_unit == '') return
      labels%length = control%length_unit
      labels%force = control%force_unit
      labels%pressure = trim(control%force_unit)//'/'//trim(control%length_unit)//'2'
      labels%area = trim(control%length_unit)//'2'
      labels%stiffness = trim(control%force_unit)//'/'//trim(control%length_unit)
   end function unit_labels


   !> The unit behind a heading, in brackets; empty where LABEL is blank.
   pure function in_units(label) result(words)
      character(*), intent(in)  :: label
      character(:), allocatable :: words

      words = ''
      if (label /= '') words = '   ('//trim(label)//')'
   end function in_units


   !> A unit as it stands under the heading of a column of WIDTH characters: at its right end, cut where it is longer.
   pure function in_column(label, width) result(words)
      character(*), intent(in) :: label
      integer, intent(in)      :: width
      character(width)         :: words

      words = label
      words = adjustr(words)
   end function in_column


   !> Stage and increment behind a heading.
   pure function where_now(plan, analysis) result(words)
      type(stage_plan_type), intent(in) :: plan
      type(analysis_type), intent(in)   :: analysis
      character(:), allocatable         :: words

      words = ', STAGE '//integer_text(plan%stages(analysis%stage)%id)//', INCREMENT '//integer_text(analysis%increment)
   end function where_now

end module listing_page
