"""A system made ready to be solved: kernel arrays, linear stiffness, its factor, residuals."""

from functools import cached_property

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8, I4, Loads, System
from trunnion.errors import NotPositiveDefiniteError
from trunnion.solver.chains import at_kept_nodes
from trunnion.solver.extended import ExtendedFactor
from trunnion.solver.inert import contacts_of, sliders_of
from trunnion.solver.ledger import Ledger
from trunnion.solver.members import (
    chain_members,
    end_forces,
    member_end_forces,
    member_loads,
    same_joints,
    whole_members,
)
from trunnion.solver.pattern import Pattern, build_pattern
from trunnion.solver.quantities import Forcing, Inside, Point, Response, Sliding

EXTENDED_PIVOT = 1e-12  # a pivot in double-double that is worth one in doubles


class Box:
    """One analysed factor, shared by structures of the same pattern.

    `owner` is the mark of the structure that filled it last, not that structure: a cycle of
    references would keep all of its arrays until the collector runs, and the next solve from
    using their memory.
    """

    def __init__(self) -> None:
        self.spd: kernels.SpdFactor | None = None
        self.owner: object = None
        self.held: tuple[F8, F8, float] | None = None
        self.rcond = 0.0


class Structure:
    """Kernel arrays of one `System`, analysed once, with one factor that is renewed on demand.

    It sees chains of elements as one member each (`solver.members`), and only the nodes between
    them, unless it is `whole`.

    A structure with a `parent` is the same pipe on other supports (frozen contacts, locked
    snubbers): it shares the parent's members, pattern, symbolic analysis and factor.  `keep`
    numbers its contacts among the contacts and then the snubbers of the parent's system.

    One that is `like` another has the same nodes, joined in the same way, with other numbers: it
    shares pattern and symbolic analysis.
    """

    def __init__(
        self,
        system: System,
        ledger: Ledger,
        parent: "Structure | None" = None,
        keep: I4 | None = None,
        *,
        whole: bool = False,
        like: "Structure | None" = None,
    ) -> None:
        self.system, self.ledger = system, ledger
        self.mark = object()
        self.shifted = self.checked = False  # a singular tangent was met; it was looked into
        self.keep, self.parent, self.like = keep, parent, like
        self.extended: ExtendedFactor | None = None
        self.soft = False  # a pipe may go far before its supports hold it
        if parent is None:
            self.members = whole_members(system) if whole else chain_members(system)
            if like is not None and not same_joints(self.members, like.members):
                like = None  # other lengths and bores may end chains at other nodes
            self.box: Box = Box() if like is None else like.box
        else:
            self.members, self.box = parent.members, parent.box
        chains = self.members.chains
        self.n_node = len(system.labels) if chains is None else len(chains.kept)
        contacts, sliders, snubbers = system.contacts, system.sliders, system.snubbers
        if chains is not None:
            contacts, sliders, snubbers = at_kept_nodes(system, chains)
        self.contacts, self.sliders = contacts_of(contacts), sliders_of(sliders)
        if parent is None:
            joined = self.members.ends, self.contacts, self.sliders, snubbers
            self.pattern: Pattern = like.pattern if like else build_pattern(self.n_node, *joined)
            self.pipe = self._assemble()
        else:
            self.pattern, self.pipe = parent.pattern, parent.pipe
            self.parent_rank = parent.rank[: len(parent.system.contacts.node)]
        self._supports()
        self._linear()

    def _assemble(self) -> F8:
        """Values of the members alone."""
        m, p = self.members, self.pattern
        pipe = np.zeros(len(p.row))
        if len(m.ends):
            kernels.assemble_elements(m.k, m.axes, m.d, m.ends, p.element_rank, p.colptr, pipe)
        self.ledger.add(elements=m.elements, assemble=1)
        return pipe

    def turn_to(self, system: System, ledger: Ledger) -> None:
        """Serve a system with the same numbers, and count work in another ledger from now on."""
        self.system, self.ledger = system, ledger
        for name in ("full", "hangers"):
            self.__dict__.pop(name, None)
        if self.box.spd is not None:
            ledger.begin(self.box, self.box.spd.work)
        if self.parent is not None:
            self.parent.turn_to(self.parent.system, ledger)

    @cached_property
    def full(self) -> "Structure":
        """The structure with every node and element: for modes, and to name motions."""
        if self.members.chains is None:
            return self
        if self.parent is None:
            like = None if self.like is None else self.like.full
            return Structure(self.system, self.ledger, whole=True, like=like)
        return Structure(self.system, self.ledger, self.parent.full, self.keep)

    @cached_property
    def kept(self) -> I4:
        """(n_node,) numbers of the equations' nodes in the model."""
        chains = self.members.chains
        return np.arange(self.n_node, dtype=np.int32) if chains is None else chains.kept

    def _supports(self) -> None:
        c, s = self.contacts, self.sliders
        p = self.pattern
        rank = p.contact_rank if self.keep is None else self._kept_rank()
        self.rank: I4 = rank
        offset = np.where(c.rotational, 3, 0)
        at = np.column_stack((c.node, c.cnode, rank, offset, c.dim, c.two_way))
        self.at = np.ascontiguousarray(at, np.int32)
        zero = np.zeros_like(s.node)
        slider_rank = p.slider_rank if len(p.slider_rank) == len(s.node) else zero
        at = np.column_stack((s.node, s.cnode, slider_rank, zero, zero, zero))
        self.slider_at = np.ascontiguousarray(at, np.int32)
        self.changes = not bool(c.two_way.all() and len(self.system.sliders.node) == 0)

    def _kept_rank(self) -> I4:
        """Places in the parent's pattern of the contacts that stand here."""
        assert self.keep is not None
        if not len(self.keep):
            return np.zeros(1, np.int32)  # of the inert stand-in
        return np.concatenate((self.parent_rank, self.pattern.snubber_rank))[self.keep]

    def _linear(self) -> None:
        """Stiffness of everything that never changes; absent freedoms get a unit diagonal."""
        p, c = self.pattern, self.contacts
        val = self.pipe.copy()
        closed = np.einsum("c,cai,caj->cij", c.k, c.normal, c.normal)
        kernels.add_tangents(self.at, closed, 1, p.colptr, val)
        whole = val.copy()  # with everything closed and stuck
        kernels.add_tangents(self.at, closed, 0, p.colptr, whole)
        basis = self.sliders.basis
        stuck = np.einsum("s,sai,saj->sij", self.sliders.kf, basis, basis)
        kernels.add_tangents(self.slider_at, stuck, 0, p.colptr, whole)
        self.absent = (whole[p.diagonal] == 0.0).reshape(-1, 6)
        self.closed_tangent, self.stuck_tangent = closed, stuck
        val[p.diagonal[self.absent.ravel()]] = 1.0
        self.val = val

    @property
    def held(self) -> tuple[F8, F8, float] | None:
        """Tangents and shift in the factor; None when it holds another structure's."""
        return self.box.held if self.box.owner is self.mark else None

    @property
    def rcond(self) -> float:
        """Upper estimate of 1 / condition number of the factor."""
        return self.box.rcond

    @cached_property
    def size(self) -> float:
        """Extent of the model [m], at least 1."""
        xyz = self.system.xyz
        return max(1.0, float(np.ptp(xyz, axis=0).max())) if len(xyz) else 1.0

    @cached_property
    def hangers(self) -> tuple[int, ...]:
        """Cards that are hangers."""
        return tuple(i for i, card in enumerate(self.system.cards) if card.kind == "hanger")

    @cached_property
    def reach(self) -> float:
        """Length of the largest element [m]; 1 where there is none."""
        arm = self.members.arm
        d: F8 = np.sqrt((arm * arm).sum(axis=1))
        return float(d.max(initial=0.0)) or 1.0

    @cached_property
    def levers(self) -> F8:
        """(6,) what a movement of one in each freedom counts, a rotation over `reach` [m]."""
        return np.array([1.0] * 3 + [self.reach] * 3)

    @cached_property
    def scale(self) -> float:
        """Largest diagonal of the members' stiffness [N/m], a size for proximal terms."""
        k = self.members.k
        return float(np.abs(k).max()) if len(k) else 1.0

    # ------------------------------------------------------------------ loads
    def forcing(self, loads: Loads) -> Forcing:
        """Kernel form of a case's loads."""
        s, c = self.system, self.contacts
        free, resultant, nodal, inside = member_loads(self.members, s, loads)
        moved, cold = loads.base, loads.preload
        if not len(moved):  # a model without supports, before it is refused as a mechanism
            moved, cold = np.zeros((1, 6)), np.zeros(1)
        base = np.where(c.rotational[:, None], moved[c.card, 3:], moved[c.card, :3])
        return Forcing(
            free,
            resultant,
            nodal,
            inside,
            np.ascontiguousarray(base),
            np.ascontiguousarray(moved[self.sliders.card, :3]),
            np.ascontiguousarray(cold[c.card, None] * s.up),
            loads.mux,
        )

    def frictionless(self) -> Sliding:
        """The law under which no support rubs."""
        n = len(self.sliders.mu)
        return Sliding(np.zeros(n), self.sliders.kf, np.zeros(n), np.zeros((n, 3)))

    @cached_property
    def still(self) -> Forcing:
        """No loads at all."""
        c, m = len(self.at), len(self.slider_at)
        six, nodal = np.zeros((len(self.members.ends), 6)), np.zeros((self.n_node, 6))
        inside = Inside(six, six, nodal)
        if self.members.chains is not None:
            every = np.zeros((self.members.elements, 6))
            inside = Inside(every, every, np.zeros((len(self.system.labels), 6)))
        three = np.zeros((c, 3))
        return Forcing(six, six, nodal, inside, three, np.zeros((m, 3)), three, 1.0)

    # ------------------------------------------------------------------ responses
    def respond(
        self, point: Point, sliding: Sliding, forcing: Forcing, r: F8, *, changing: bool = False
    ) -> Response:
        """Support forces at a point, added to r (only those that may change state, if asked)."""
        c, s = self.contacts, self.sliders
        return Response(
            sliding.capacity,
            *kernels.contact_pass(
                self.at,
                c.normal,
                c.gap,
                c.k,
                forcing.base,
                forcing.preload,
                self.slider_at,
                s.basis,
                sliding.kf,
                sliding.mu,
                sliding.coupled,
                changing,
                forcing.slider_base,
                sliding.datum,
                s.first,
                s.contact,
                point.u,
                point.low,
                sliding.capacity,
                r,
            ),
        )

    def residual(self, point: Point, sliding: Sliding, forcing: Forcing) -> tuple[F8, F8, Response]:
        """Out-of-balance force at the nodes, end forces of the members, support response."""
        r = forcing.nodal.copy()
        response = self.respond(point, sliding, forcing, r)
        return r, self.member_forces(point, forcing, r), response

    def member_forces(self, point: Point, forcing: Forcing, r: F8) -> F8:
        """End forces (n_member, 2, 6) of the members, taken off r."""
        self.ledger.add(elements=len(self.members.ends))
        return member_end_forces(self.members, forcing, point, r)

    def exact(
        self, point: Point, sliding: Sliding, forcing: Forcing, bias: F8
    ) -> tuple[F8, Point, F8, Response]:
        """Like `residual`, with every element; also the displacements of all nodes.

        `bias` (n_member, 6), zero at first, keeps what makes the next call shorter.
        """
        r = forcing.nodal.copy()
        response = self.respond(point, sliding, forcing, r)
        every, end = end_forces(self.members, self.system, forcing, point, r, bias)
        self.ledger.add(elements=self.members.elements)
        return r, every, end, response

    def unbiased(self) -> F8:
        """Start of the `bias` of `exact`."""
        return np.zeros((len(self.members.ends), 6))

    def search(
        self, point: Point, sliding: Sliding, forcing: Forcing, p: F8, work: tuple[float, float]
    ) -> float:
        """Length of the step along p at which the energy of fixed capacities is least."""
        c, s = self.contacts, self.sliders
        step, _ = kernels.line_search(
            self.at,
            c.normal,
            c.gap,
            c.k,
            forcing.base,
            self.slider_at,
            s.basis,
            sliding.kf,
            sliding.capacity,
            forcing.slider_base,
            sliding.datum,
            point.u,
            point.low,
            p,
            np.array(work),
        )
        return float(step)

    # ------------------------------------------------------------------ factor
    def factorise(self, tangent: F8, slider_tangent: F8, shift: float = 0.0) -> bool:
        """Renew the factor for these tangents unless it is theirs already.

        Returns whether the matrix is positive definite.
        """
        held = self.held
        if held is not None and (
            held[2] == shift
            and np.array_equal(held[0], tangent)
            and np.array_equal(held[1], slider_tangent)
        ):
            return True
        if self.extended is not None:
            return self._factorise_extended(self.extended, tangent, slider_tangent, shift)
        box = self.box
        self.analyse()
        assert box.spd is not None
        val = self.val
        if self.changes:
            val = val.copy()
            kernels.add_tangents(self.at, tangent, 0, self.pattern.colptr, val)
            kernels.add_tangents(self.slider_at, slider_tangent, 0, self.pattern.colptr, val)
        box.owner = None
        self.shifted |= shift > 0.0
        try:
            box.rcond = box.spd.factorise(val, shift)
        except NotPositiveDefiniteError:
            return False
        finally:
            self.ledger.follow(box, box.spd.work)
        box.owner, box.held = self.mark, (tangent, slider_tangent, shift)
        return True

    def _factorise_extended(
        self, factor: ExtendedFactor, tangent: F8, slider_tangent: F8, shift: float
    ) -> bool:
        """The same in double-double, whose pivots may be 1e-12 of those of doubles."""
        box = self.box
        box.owner = None
        self.shifted |= shift > 0.0
        self.ledger.add(extended=1)
        try:
            box.rcond = factor.factorise(tangent, slider_tangent, shift) / EXTENDED_PIVOT
        except NotPositiveDefiniteError:
            return False
        box.owner, box.held = self.mark, (tangent, slider_tangent, shift)
        return True

    def extend(self, extended: bool) -> bool:
        """Factor in double-double from now on, or no longer; tells whether that can be done."""
        self.box.owner, self.extended = None, None
        if extended:
            factor = ExtendedFactor(self)
            self.extended = factor if factor.feasible else None
        return self.extended is not None

    def analyse(self) -> None:
        """Make the symbolic analysis, unless there is one."""
        if self.box.spd is None:
            self.box.spd = kernels.SpdFactor(self.pattern.colptr, self.pattern.row)
            self.ledger.follow(self.box, self.box.spd.work)

    def solve(self, r: F8) -> F8:
        """Displacements (n_node, 6) of the factored stiffness under r; or (m, n_node, 6)."""
        if self.extended is not None:
            rows = self.extended.solve(r.reshape(-1, 6 * self.n_node))
            self.ledger.add(**{"refine" if self.ledger.refining else "solve": len(rows)})
            return rows.reshape(r.shape)
        spd = self.box.spd
        assert spd is not None
        assert self.box.owner is self.mark
        shape = r.shape
        x = spd.solve(r.reshape(-1, 6 * self.n_node))
        self.ledger.follow(self.box, spd.work)
        return x.reshape(shape)

    def product(self, tangent: F8, slider_tangent: F8, v: F8) -> F8:
        """K v with the members' part formed from deformations; zero at absent freedoms."""
        v = np.ascontiguousarray(v)
        r = np.zeros_like(v)
        self.member_forces(Point(v, np.zeros_like(v)), self.still, r)
        kernels.contact_product(self.at, tangent, True, v, r)
        self.sliders_product(slider_tangent, v, r)
        r[self.absent] = 0.0
        return -r

    def changing_product(self, response: Response, p: F8, r: F8) -> None:
        """Subtract from r the share of K p that comes from contacts which may change."""
        kernels.contact_product(self.at, response.tangent, False, p, r)
        self.sliders_product(response.slider_tangent, p, r)

    def sliders_product(self, slider_tangent: F8, p: F8, r: F8) -> None:
        """Subtract from r the share of K p that comes from sliders."""
        kernels.contact_product(self.slider_at, slider_tangent, True, p, r)

    def coupling(self, response: Response, sliding: Sliding, p: F8) -> tuple[F8, F8]:
        """Change of sliding friction forces through their normal forces for a change p.

        Returns the nodal forces (n_node, 6) and the change of each slider's normal force.
        """
        r = np.zeros_like(p)
        change = kernels.coupling_product(
            self.at,
            response.tangent,
            self.slider_at,
            sliding.mu,
            response.mode,
            response.friction,
            self.sliders.first,
            self.sliders.contact,
            response.reaction,
            p,
            r,
        )
        return r, change

    def scatter(self, force: F8, r: F8) -> None:
        """Add contact forces (n_contact, 3) to the nodes' r, and their opposites at cnodes."""
        kernels.scatter(self.at, force, r)

    def gather(self, p: F8) -> F8:
        """Relative displacements (n_contact, 3) of the contacts for displacements p."""
        return kernels.gather(self.at, p)
