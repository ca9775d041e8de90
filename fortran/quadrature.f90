!> Gauss-Legendre rule of 24 points for integrals along an element.
module quadrature
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: n_point, station, weight

   integer, parameter :: n_half = 12
   !> Positive half of the 24-point rule; Abramowitz and Stegun (1964), table 25.4.
   real(wp), parameter :: half_node(n_half) = [ &
      & 0.0640568928626056260_wp, 0.1911188674736163091_wp, 0.3150426796961633743_wp, &
      & 0.4337935076260451384_wp, 0.5454214713888395356_wp, 0.6480936519369755692_wp, &
      & 0.7401241915785543642_wp, 0.8200019859739029219_wp, 0.8864155270044010342_wp, &
      & 0.9382745520027327585_wp, 0.9747285559713094981_wp, 0.9951872199970213601_wp]
   real(wp), parameter :: half_weight(n_half) = [ &
      & 0.1279381953467521569_wp, 0.1258374563468282961_wp, 0.1216704729278033912_wp, &
      & 0.1155056680537256013_wp, 0.1074442701159656347_wp, 0.0976186521041138882_wp, &
      & 0.0861901615319532759_wp, 0.0733464814110803057_wp, 0.0592985849154367807_wp, &
      & 0.0442774388174198061_wp, 0.0285313886289336631_wp, 0.0123412297999871995_wp]
   integer, parameter :: n_point = 2*n_half

contains

   !> Abscissa of point i of the rule on (0, span).
   pure function station(span, i) result(t)
      real(wp), intent(in) :: span
      integer, intent(in) :: i
      real(wp) :: t

      if (i <= n_half) then
         t = 0.5_wp*span*(1.0_wp - half_node(i))
      else
         t = 0.5_wp*span*(1.0_wp + half_node(i - n_half))
      end if
   end function station

   pure function weight(span, i) result(w)
      real(wp), intent(in) :: span
      integer, intent(in) :: i
      real(wp) :: w

      w = 0.5_wp*span*half_weight(merge(i, i - n_half, i <= n_half))
   end function weight

end module quadrature
