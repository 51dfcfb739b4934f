!> The file NAME.dmig: stiffness and mass condensed on some components of nodes, as DMIG cards that NASTRAN and programs for multi-body
!! dynamics read.
module dmig_file
   use kinds, only: wp
   use mesh_queries, only: n_points
   use model_data, only: model_type
   use result_page, only: dmig_table, page_type
   use superelement, only: reduced_type
   use tolerances, only: rounding_of_sums
   use text_tools, only: integer_text, one_of, plural, real_text, upper
   implicit none
   private

   public :: list_superelement, dmig_number

contains

   !> Write REDUCED to the file, and a line to the listing. The names of the matrices are KAAX and MAAX, or where MANY stages have them
   !! KAAn and MAAn with the number n of the stage.
   subroutine list_superelement(page, model, many, reduced)
      type(page_type), intent(inout)  :: page
      type(model_type), intent(in)    :: model
      logical, intent(in)             :: many
      type(reduced_type), intent(in)  :: reduced
      character(:), allocatable :: suffix
      integer, allocatable :: component(:), id(:)
      integer :: first, i, n_a

      suffix = 'X'
      if (many) suffix = integer_text(page%stage_id)
      associate (retained => reduced%retained, n => reduced%n_modes)
         n_a = size(retained%id)
         first = maxval(model%mesh%node_id(:n_points(model%mesh))) + 1
         if (size(retained%mode_id) > 0) then
            id = [retained%id, retained%mode_id(:n)]
            component = [retained%component, retained%mode_component(:n)]
         else
            id = [retained%id, (first + i - 1, i = 1, n)]
            component = [retained%component, (0, i = 1, n)]
         end if
         call page%file%put('')
         call page%file%put('  STIFFNESS KAA'//suffix//' AND MASS MAA'//suffix//', CONDENSED ON '// &
            upper(plural(n_a, 'component'))//' OF NODES'//one_of(n > 0, ' AND '//upper(plural(n, 'mode'))// &
            ' WITH THESE HELD, UP TO '//real_text(reduced%highest), '')//': DMIG CARDS OF THE FILE .dmig')
         associate (file => page%tables(dmig_table))
            if (.not. file%is_open) return
            call file%put('$ stage '//integer_text(page%stage_id)//': '//plural(n_a, 'component')//' of nodes, '//plural(n, 'mode'))
            if (n > 0 .and. size(retained%mode_id) == 0) &
               call file%put('SPOINT  '//padded(first)//one_of(n > 1, 'THRU    '//padded(first + n - 1), ''))
            call put_matrix('KAA'//suffix, reduced%k)
            call put_matrix('MAA'//suffix, reduced%m)
         end associate
      end associate

   contains

      !> The cards of the symmetric matrix A: a header, and the lower triangle column by column.
      subroutine put_matrix(name, a)
         character(*), intent(in) :: name
         real(wp), intent(in)     :: a(:, :)
         character(80) :: line
         integer :: column, row

         associate (file => page%tables(dmig_table))
            write (line, '(a8, a8, 4i8)') 'DMIG    ', name//'    ', 0, 6, 2, 0
            call file%put(trim(line))
            do column = 1, size(a, 2)
               if (.not. abs(a(column, column)) > 0.0_wp) cycle
               write (line, '(a8, a16, 2i16)') 'DMIG*   ', name//repeat(' ', 12), id(column), component(column)
               call file%put(trim(line))
               do row = column, size(a, 1) ! without what rounding leaves
                  if (abs(a(row, column)) <= rounding_of_sums*sqrt(abs(a(row, row)*a(column, column)))) cycle
                  write (line, '(a8, 2i16, a16)') '*       ', id(row), component(row), dmig_number(a(row, column))
                  call file%put(trim(line))
               end do
            end do
         end associate
      end subroutine put_matrix

   end subroutine list_superelement

   !> ID in a field of eight columns.
   pure function padded(id) result(field)
      integer, intent(in) :: id
      character(8) :: field

      field = integer_text(id)
   end function padded

   !> X in double precision with as many digits as 16 columns hold, such as -1.23456789012D-4.
   pure function dmig_number(x) result(text)
      real(wp), intent(in) :: x
      character(16) :: text
      character(40) :: long
      character(:), allocatable :: short
      integer :: digits, exponent

      short = ''
      do digits = 14, 1, -1
         write (long, '(es40.'//integer_text(digits)//'e3)') x
         read (long(index(long, 'E') + 1:), *) exponent
         short = trim(adjustl(long(:index(long, 'E') - 1)))
         short = short(:max(verify(short, '0', back=.true.), index(short, '.') + 1))//'D'//integer_text(exponent)
         if (len(short) <= len(text)) exit
      end do
      text = adjustr(short//repeat(' ', len(text) - len(short)))
   end function dmig_number

end module dmig_file
