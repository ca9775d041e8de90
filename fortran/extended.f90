!> Double-double sums and products: a value is the unevaluated sum hi + lo, about 32 digits.
!>
!> Error-free transformations of Knuth (two_sum) and Dekker (two_prod), in the form of
!> Hida, Li and Bailey (2001), "Library for double-double and quad-double arithmetic".
!> They hold only without fused or reordered arithmetic: the build passes -ffp-contract=off.
module extended
   use kinds, only: wp
   implicit none (type, external)
   private
   public :: add_dd, add_product, divide_dd, multiply_dd, split, two_prod, two_sum

   real(wp), parameter :: splitter = 134217729.0_wp   !! 2**27 + 1

contains

   !> s + e = a + b exactly.
   elemental subroutine two_sum(a, b, s, e)
      real(wp), intent(in) :: a, b
      real(wp), intent(out) :: s, e

      real(wp) :: t

      s = a + b
      t = s - a
      e = (a - (s - t)) + (b - t)
   end subroutine two_sum

   !> a = high + low exactly, with 26 digits each: products of such are exact (Dekker).
   elemental subroutine split(a, high, low)
      real(wp), intent(in) :: a
      real(wp), intent(out) :: high, low

      real(wp) :: t

      t = splitter*a
      high = t - (t - a)
      low = a - high
   end subroutine split

   !> p + e = a b exactly, unless the product over- or underflows.
   elemental subroutine two_prod(a, b, p, e)
      real(wp), intent(in) :: a, b
      real(wp), intent(out) :: p, e

      real(wp) :: a1, a2, b1, b2

      p = a*b
      call split(a, a1, a2)
      call split(b, b1, b2)
      e = ((a1*b1 - p) + a1*b2 + a2*b1) + a2*b2
   end subroutine two_prod

   !> (hi, lo) <- (hi, lo) + (a, a_low), renormalised.
   elemental subroutine add_dd(hi, lo, a, a_low)
      real(wp), intent(inout) :: hi, lo
      real(wp), intent(in) :: a, a_low

      real(wp) :: s, e

      call two_sum(hi, a, s, e)
      e = e + (lo + a_low)
      hi = s + e
      lo = e - (hi - s)
   end subroutine add_dd

   !> (hi, lo) <- (hi, lo) + (a, a_low) b, with b a plain real.
   elemental subroutine add_product(hi, lo, a, a_low, b)
      real(wp), intent(inout) :: hi, lo
      real(wp), intent(in) :: a, a_low, b

      real(wp) :: p, e

      call two_prod(a, b, p, e)
      call add_dd(hi, lo, p, e + a_low*b)
   end subroutine add_product

   !> (p, p_low) = (a, a_low) (b, b_low).
   elemental subroutine multiply_dd(a, a_low, b, b_low, p, p_low)
      real(wp), intent(in) :: a, a_low, b, b_low
      real(wp), intent(out) :: p, p_low

      real(wp) :: s, e

      call two_prod(a, b, s, e)
      e = e + (a*b_low + a_low*b)
      p = s + e
      p_low = e - (p - s)
   end subroutine multiply_dd

   !> (q, q_low) = (a, a_low) / (b, b_low).
   elemental subroutine divide_dd(a, a_low, b, b_low, q, q_low)
      real(wp), intent(in) :: a, a_low, b, b_low
      real(wp), intent(out) :: q, q_low

      real(wp) :: r, r_low, p, p_low

      q = a/b
      call multiply_dd(b, b_low, q, 0.0_wp, p, p_low)
      r = a
      r_low = a_low
      call add_dd(r, r_low, -p, -p_low)
      q_low = (r + r_low)/b
      p = q + q_low
      q_low = q_low - (p - q)
      q = p
   end subroutine divide_dd

end module extended
