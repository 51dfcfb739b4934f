!> Which of the solvers takes least time, and does not take more memory than there is: what TREE counts, operations and bytes, against
!! rates that have been measured. What a processor is worth in one of them it is worth in the others, about: only quotients count.
module solver_weighing
   use case_control, only: solver_mumps, solver_petsc, solver_tree
   use kinds, only: wp
   use text_tools, only: integer_text
   implicit none
   private

   public :: weigh_solvers, weighing_words

   !> What is to be done, and by how many.
   type, public :: solver_work_type
      real(wp) :: fixed_operations = 0.0_wp  !! of TREE, once
      real(wp) :: moving_operations = 0.0_wp !! of TREE, in every increment
      real(wp) :: bytes = 0.0_wp             !! that TREE needs
      real(wp) :: there = 0.0_wp             !! that there are, to the process that it runs in
      real(wp) :: entries = 0.0_wp           !! of the stiffness matrix
      integer  :: solutions = 20             !! with another stiffness of the joints each
      integer  :: threads = 1, processes = 1
   end type solver_work_type

   integer, parameter, public :: weighed(3) = [solver_tree, solver_petsc, solver_mumps]

   ! one core that multiplies matrices by 60 GFlop/s, blocks of 20 to 60 elements along each edge:
   real(wp), parameter :: tree_rate = 4.0e10_wp        ! operations in fronts [1/s]
   real(wp), parameter :: mumps_rate = 2.5e10_wp       ! likewise, all of them in every increment
   real(wp), parameter :: set_up_time = 2.2e-7_wp      ! of GAMG, of an entry [s]
   real(wp), parameter :: solution_time = 5.0e-8_wp    ! some ten steps, from the best sum of earlier solutions on [s]
   integer, parameter  :: solutions_a_set_up = 4       ! that a preconditioner serves
   real(wp), parameter :: gain = 0.8_wp                ! of each further thread or process

contains

   !> SECONDS of the solvers WEIGHED, and which is the BEST. Where a factor does not fit into the memory only PETSC is.
   pure subroutine weigh_solvers(work, seconds, best)
      type(solver_work_type), intent(in) :: work
      real(wp), intent(out)              :: seconds(size(weighed))
      integer, intent(out)               :: best !! solver_*

      associate (n => work%solutions, hands => 1.0_wp + gain*(work%processes - 1))
         seconds = [(work%fixed_operations + n*work%moving_operations)/(tree_rate*(1.0_wp + gain*(work%threads - 1))), &
                    work%entries*(n*solution_time + (1 + n/solutions_a_set_up)*set_up_time)/hands, &
                    n*(work%fixed_operations + work%moving_operations)/(mumps_rate*hands)]
      end associate
      best = weighed(minloc(seconds, dim=1, mask=[work%bytes <= work%there, .true., work%bytes <= work%there]))
   end subroutine weigh_solvers

   !> Why it is not TREE, for the listing.
   pure function weighing_words(work) result(words)
      type(solver_work_type), intent(in) :: work
      character(:), allocatable :: words
      real(wp) :: seconds(size(weighed))
      integer  :: best

      call weigh_solvers(work, seconds, best)
      words = ''
      if (best == solver_tree) return
      if (work%bytes > work%there) then
         words = 'AUTO: TREE WOULD NEED '//integer_text(nint(work%bytes/1048576.0_wp))//' MIB, MORE THAN THERE ARE'
      else
         words = 'AUTO: BY THE COUNT TREE TAKES '//quotient(seconds(1)/seconds(2))//' TIMES AS LONG AS PETSC, MUMPS '// &
                 quotient(seconds(3)/seconds(2))
      end if
   end function weighing_words

   pure function quotient(value) result(text)
      real(wp), intent(in)      :: value
      character(:), allocatable :: text
      character(12) :: digits

      write (digits, '(f12.1)') min(value, 1.0e6_wp)
      text = trim(adjustl(digits))
   end function quotient

end module solver_weighing
