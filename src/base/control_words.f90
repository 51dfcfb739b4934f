!> The words of case control that choose methods and solvers, as numbers: the position of the word in its list.
!! Case control reads them; the folders that follow the choice need no module of the deck for it.
module control_words
   implicit none
   private

   character(*), parameter, public :: model_words = '|PLANE|AXISYMMETRIC|SPACE|'            !! MODEL =
   integer, parameter, public :: model_plane = 1, model_axisymmetric = 2, model_space = 3

   character(*), parameter, public :: method_words = '|STEP|NEWTON|BACK|'                   !! METHOD =
   integer, parameter, public :: method_step = 1, method_newton = 2, method_back = 3

   character(*), parameter, public :: pressure_words = '|SUMF|EQ10|'                        !! PRESSURE =
   integer, parameter, public :: pressure_sumf = 1, pressure_eq10 = 2

   character(*), parameter, public :: solver_words = '|AUTO|SKYLINE|TREE|PETSC|MUMPS|'      !! SOLVER =
   integer, parameter, public :: solver_auto = 1, solver_skyline = 2, solver_tree = 3, solver_petsc = 4, solver_mumps = 5

   integer, parameter, public :: no_restart = -1, restart_stages = 0                        !! RESTART =, or a number of increments

end module control_words
