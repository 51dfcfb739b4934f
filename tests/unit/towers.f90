!> Towers of nodes, each on a joint, for tests of the ways through an increment.
module towers
   use equations, only: equation_system, form_body_stiffness, start_equations
   use equation_solver, only: failure_type
   use interface_operator, only: connect_nodes
   use joint_laws, only: joint_law
   use kinds, only: wp
   use mesh_queries, only: start_parts
   use model_data, only: model_type
   use normal_curve, only: normal_law
   use shear_curves, only: one_cubic
   use stage_plan, only: stage_plan_type
   implicit none
   private

   public :: make_tower, put_load, rough

   real(wp), parameter, public :: area = 100.0_wp !! of every interface element

contains

   !> N nodes in a row upwards: node 1 on the base, node i + 1 on node i, normals downwards, each in a joint of its own with LAW;
   !! free along the normal, and along x too where SIDEWAYS.
   subroutine make_tower(n, law, sideways, model, plan, system)
      integer, intent(in)                :: n
      type(joint_law), intent(in)        :: law
      logical, intent(in)                :: sideways
      type(model_type), intent(out)      :: model
      type(stage_plan_type), intent(out) :: plan
      class(equation_system), allocatable, intent(out) :: system
      type(failure_type) :: failure
      integer :: i

      call start_parts(model)
      model%mesh%n_nodes = n
      allocate (model%mesh%node_id(n), model%mesh%x(3, n), model%freedoms%used(n), model%freedoms%held(2, n), &
         model%mesh%element_nodes(4, 0))
      allocate (model%mesh%first_at(n + 1), model%mesh%elements_at(0), model%joints%element(n), model%joints%list(n), &
         model%history%stages(2))
      model%mesh%node_id = [(100 + i, i=1, n)]
      model%mesh%x = 0.0_wp
      model%freedoms%n_parts = n
      model%freedoms%part = [(i, i=1, n)]
      model%freedoms%used = .true.
      model%freedoms%held = .false.
      model%freedoms%held(1, :) = .not. sideways
      model%mesh%first_at = 1
      do i = 1, n
         model%joints%element(i)%joint = i
         call connect_nodes(model%joints%element(i), i, i - 1)
         model%joints%element(i)%area = area
         model%joints%element(i)%axes = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, -1.0_wp, 0.0_wp], [3, 3])
         model%joints%list(i)%law = law
         model%joints%list(i)%p_av = 0.5_wp
         model%joints%list(i)%first = i
         model%joints%list(i)%last = i
      end do
      allocate (plan%stages(2))
      do i = 1, 2
         plan%stages(i)%id = i
         plan%stages(i)%fractions = [1.0_wp]
      end do
      call start_equations(model, system, failure)
      call form_body_stiffness(model, system, failure)
   end subroutine make_tower

   !> Load at the end of stage S: FORCE at node NODE.
   subroutine put_load(model, s, node, force)
      type(model_type), intent(inout) :: model
      integer, intent(in)             :: s, node
      real(wp), intent(in)            :: force(2)

      model%history%stages(s)%n = 1
      model%history%stages(s)%node = [node]
      model%history%stages(s)%force = reshape([force, 0.0_wp], [3, 1])
   end subroutine put_load

   !> A law with shear and friction.
   pure function rough() result(law)
      type(joint_law) :: law

      law%normal = normal_law(c=8.0e-3_wp, m=0.5_wp, e_u=500.0_wp)
      law%shear(1) = one_cubic([100.0_wp, 300.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      law%has_friction = .true.
      law%mu = 0.2_wp
   end function rough

end module towers
