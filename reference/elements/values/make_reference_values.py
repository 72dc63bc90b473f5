#!/usr/bin/env python3
"""Numbers of another finite element code, scikit-fem, that tests hold core and reference to.

    python3 -m venv DIR && DIR/bin/pip install scikit-fem==12.0.2 numpy scipy
    DIR/bin/python make_reference_values.py      writes reference_values.json and reference_values.sha256 beside it

Two minutes or so. Nothing that is built or tested runs it: what it wrote is committed, with the hashes of both files, so
that neither changes without the other (`sha256sum --check reference_values.sha256` is a test).

Single elements, linearly elastic: consistent mass and stiffness, by their nodes in the order that is printed with them,
three unknowns to a node. And the beam of `dartboard validate elements` in 27-node hexahedra: the work of a shear
traction of 1 Pa on its free end, and its six lowest angular frequencies.
"""

import hashlib
import json
import os

import numpy as np
import scipy
import skfem
from scipy.sparse.linalg import LinearOperator, eigsh, splu
from skfem.helpers import ddot, dot, sym_grad, trace

YOUNG, DENSITY = 1e5, 1000.0
HERE = os.path.dirname(os.path.abspath(__file__))


def lame(poisson):
    return YOUNG * poisson / ((1 + poisson) * (1 - 2 * poisson)), YOUNG / (2 * (1 + poisson))


def matrices(basis, poisson):
    """Stiffness and consistent mass, assembled."""
    la, mu = lame(poisson)

    @skfem.BilinearForm
    def stiffness(u, v, _):
        e = sym_grad(u)
        return 2 * mu * ddot(e, sym_grad(v)) + la * trace(e) * trace(sym_grad(v))

    @skfem.BilinearForm
    def mass(u, v, _):
        return DENSITY * dot(u, v)

    return stiffness.assemble(basis), mass.assemble(basis)


def element(mesh, kind, order, poisson, mass_order):
    """One cell: its nodes, and its matrices with three unknowns to a node."""
    basis = skfem.Basis(mesh, skfem.ElementVector(kind), intorder=order)
    stiffness, _ = matrices(basis, poisson)
    _, mass = matrices(skfem.Basis(mesh, skfem.ElementVector(kind), intorder=mass_order), poisson)
    # rows of three numbers: the unknowns of one vertex, and of one edge
    unknowns = [column for dofs in (basis.nodal_dofs, basis.edge_dofs) if dofs.size for column in dofs.T]
    assert all(len(column) == 3 for column in unknowns) and 3 * len(unknowns) == stiffness.shape[0]
    at = np.concatenate(unknowns)
    return {
        "poisson": poisson,
        "nodes": [[float(c) for c in basis.doflocs[:, column[0]]] for column in unknowns],
        "stiffness": stiffness.toarray()[np.ix_(at, at)].tolist(),
        "mass": mass.toarray()[np.ix_(at, at)].tolist(),
    }


def elements():
    tetrahedron = np.array([[0.1, 0.2, -0.1], [1.3, 0.1, 0.2], [0.4, 0.9, 0.1], [0.7, 0.3, 1.2]]).T
    tetrahedra = skfem.MeshTet(tetrahedron, np.array([[0, 1, 2, 3]]).T)
    # the corners of a unit cube, each moved by up to a fifth
    cube = skfem.MeshHex()
    moved = cube.p + 0.2 * np.array([np.sin(1.0 + 2.0 * np.arange(8)), np.cos(3.0 * np.arange(8)), np.sin(5.0 * np.arange(8))])
    hexahedron = skfem.MeshHex(np.round(moved, 3), cube.t)
    return {
        "linear tetrahedron": element(tetrahedra, skfem.ElementTetP1(), 2, 0.3, 2),
        "quadratic tetrahedron": element(tetrahedra, skfem.ElementTetP2(), 4, 0.3, 4),
        # two Gauss points along each axis, which is full integration; masses have their integrals exactly with three
        "hexahedron": element(hexahedron, skfem.ElementHex1(), 3, 0.3, 5),
    }


def beam(across, poisson):
    """1 x 0.2 x 0.2 m, held at x = 0."""
    along, side = np.linspace(0, 1, 5 * across + 1), np.linspace(0, 0.2, across + 1)
    mesh = skfem.MeshHex.init_tensor(along, side, side)
    kind = skfem.ElementVector(skfem.ElementHex2())
    basis = skfem.Basis(mesh, kind, intorder=5)  # three points along each axis: exact for boxes
    stiffness, mass = matrices(basis, poisson)
    end = skfem.FacetBasis(mesh, kind, intorder=5, facets=mesh.facets_satisfying(lambda x: np.isclose(x[0], 1)))
    load = skfem.LinearForm(lambda v, _: v[2]).assemble(end)
    free = basis.complement_dofs(basis.get_dofs(lambda x: np.isclose(x[0], 0)))
    k, m, f = stiffness[free][:, free].tocsc(), mass[free][:, free].tocsc(), load[free]
    factor = splu(k, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    u = factor.solve(f)
    start = np.random.default_rng(1).standard_normal(len(f))  # the same numbers each time
    squares, _ = eigsh(k, 6, m, sigma=0, OPinv=LinearOperator(k.shape, factor.solve), v0=start, tol=1e-12)
    return {
        "poisson": poisson,
        "across": across,
        "unknowns": int(basis.N),
        "work": float(f @ u),
        "frequencies": [float(w) for w in np.sqrt(np.sort(squares))],
    }


def main():
    values = {
        "made by": "scikit-fem %s, numpy %s, scipy %s" % (skfem.__version__, np.__version__, scipy.__version__),
        "young": YOUNG,
        "density": DENSITY,
        "elements": elements(),
        "beam": [beam(across, poisson) for poisson in (0.25, 0.3, 0.45) for across in (4, 6)],
    }
    written = os.path.join(HERE, "reference_values.json")
    with open(written, "w", encoding="utf-8") as file:
        json.dump(values, file, indent=1)
        file.write("\n")
    with open(os.path.join(HERE, "reference_values.sha256"), "w", encoding="utf-8") as file:
        for name in (os.path.basename(__file__), os.path.basename(written)):
            with open(os.path.join(HERE, name), "rb") as source:
                file.write("%s  %s\n" % (hashlib.sha256(source.read()).hexdigest(), name))


if __name__ == "__main__":
    main()
