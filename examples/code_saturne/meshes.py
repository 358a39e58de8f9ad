"""Meshes for code_saturne as gmsh 2.2 text: a duct along x and a half pipe along z. Standard library only.

The preprocessor keeps numbers of groups, not their names: 1 inlet, 2 outlet, 3 wall, 4 symmetry, 5 the part of the
inlet that particles come from.
"""
import math

INLET, OUTLET, WALL, SYMMETRY, SOURCE, CELLS = 1, 2, 3, 4, 5, 10
TRIANGLE, QUADRANGLE, HEXAHEDRON, PRISM = 2, 3, 5, 6


def write_mesh(path, nodes, elements):
    """Nodes are triples; an element is (gmsh type, group, node numbers from 0)."""
    with open(path, "w") as out:
        out.write(f"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{len(nodes)}\n")
        out.writelines(f"{k} {x:.12g} {y:.12g} {z:.12g}\n" for k, (x, y, z) in enumerate(nodes, 1))
        out.write(f"$EndNodes\n$Elements\n{len(elements)}\n")
        out.writelines(f"{k} {kind} 2 {group} {group} {' '.join(str(n + 1) for n in corners)}\n"
                       for k, (kind, group, corners) in enumerate(elements, 1))
        out.write("$EndElements\n")


def write_duct(path, size, cells):
    """A box of size [m] in hexahedra; flow along x, walls on the four sides, particles from all of the inlet."""
    nx, ny, nz = cells

    def node(i, j, k):
        return i + (nx + 1) * (j + (ny + 1) * k)

    nodes = [(size[0] * i / nx, size[1] * j / ny, size[2] * k / nz)
             for k in range(nz + 1) for j in range(ny + 1) for i in range(nx + 1)]
    elements = []
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                low = [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]
                elements.append((HEXAHEDRON, CELLS, low + [n + (nx + 1) * (ny + 1) for n in low]))
    for k in range(nz):
        for j in range(ny):
            for i, group in ((0, SOURCE), (nx, OUTLET)):
                elements.append((QUADRANGLE, group, [node(i, j, k), node(i, j + 1, k), node(i, j + 1, k + 1), node(i, j, k + 1)]))
        for i in range(nx):
            for j in (0, ny):
                elements.append((QUADRANGLE, WALL, [node(i, j, k), node(i + 1, j, k), node(i + 1, j, k + 1), node(i, j, k + 1)]))
    for j in range(ny):
        for i in range(nx):
            for k in (0, nz):
                elements.append((QUADRANGLE, WALL, [node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k)]))
    write_mesh(path, nodes, elements)


def spread(low, high, n):
    return [low + (high - low) * k / n for k in range(n)]


def half_pipe_lines(radius, source, fine):
    """Radii and angles of a section; the source, a square about (0, radius / 2), lies between lines of each mesh."""
    near, far = radius / 2 - source / 2, radius / 2 + source / 2
    half = source / radius  # angle of half the source at radius / 2
    radii = spread(0, near, 2 * fine) + spread(near, far, fine // 2 + 1) + spread(far, radius, 2 * fine) + [radius]
    side = 4 * fine
    angles = (spread(0, math.pi / 2 - half, side) + spread(math.pi / 2 - half, math.pi / 2 + half, fine // 2 + 1)
              + spread(math.pi / 2 + half, math.pi, side) + [math.pi])
    return radii, angles, (near, far, half)


def write_half_pipe(path, radius, length, source, fine, layers):
    """Rings of hexahedra about a row of prisms, flow along z, y >= 0; the flat side is a plane of symmetry.

    source: side of the square at the inlet that particles come from [m]. Returns the number of cells.
    """
    radii, angles, (near, far, half) = half_pipe_lines(radius, source, fine)
    n_ring, n_angle = len(radii) - 1, len(angles) - 1
    layer = 1 + n_ring * (n_angle + 1)
    nodes = []
    for k in range(layers + 1):
        z = length * k / layers
        nodes.append((0.0, 0.0, z))
        nodes += [(r * math.cos(a), r * math.sin(a) if 0 < j < n_angle else 0.0, z)
                  for r in radii[1:] for j, a in enumerate(angles)]

    def node(ring, j, k):
        return k * layer + (0 if ring == 0 else 1 + (ring - 1) * (n_angle + 1) + j)

    def side(group, corners):
        return (TRIANGLE if len(corners) == 3 else QUADRANGLE, group, corners)

    def section(ring, j, k):
        ends = [node(ring, j, k), node(ring + 1, j, k), node(ring + 1, j + 1, k), node(ring, j + 1, k)]
        return ends[:3] if ring == 0 else ends

    def is_source(ring, j):
        r, a = (radii[ring] + radii[ring + 1]) / 2, (angles[j] + angles[j + 1]) / 2
        return near < r < far and abs(a - math.pi / 2) < half

    elements = []
    for k in range(layers):
        for ring in range(n_ring):
            for j in range(n_angle):
                low = section(ring, j, k)
                elements.append((PRISM if ring == 0 else HEXAHEDRON, CELLS, low + [n + layer for n in low]))
    n_cell = len(elements)
    for ring in range(n_ring):
        for j in range(n_angle):
            elements.append(side(SOURCE if is_source(ring, j) else INLET, section(ring, j, 0)))
            elements.append(side(OUTLET, section(ring, j, layers)))
        for k in range(layers):
            for j in (0, n_angle):
                elements.append(side(SYMMETRY, [node(ring, j, k), node(ring + 1, j, k), node(ring + 1, j, k + 1), node(ring, j, k + 1)]))
    for k in range(layers):
        for j in range(n_angle):
            elements.append(side(WALL, [node(n_ring, j, k), node(n_ring, j + 1, k), node(n_ring, j + 1, k + 1), node(n_ring, j, k + 1)]))
    write_mesh(path, nodes, elements)
    return n_cell
