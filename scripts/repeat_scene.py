#!/usr/bin/env python3
# SPDX-FileCopyrightText: The gloam authors
# SPDX-License-Identifier: MIT
"""Writes a glTF scene that shows the meshes of another one many times, cut into pieces, for measurements of scenes with
many triangles. Buffers and images are copied beside it. Needs python3-numpy.

usage: repeat_scene.py SOURCE.gltf OUT.gltf [--copies 40] [--piece 448] [--in-view CAMERA]

Copies stand in rows, as near to each other as their bounds allow. The first copy is the source with its lights,
effects and cameras. The others have its meshes, skins and animations. Each primitive without a skin is cut into meshes
of at most --piece triangles. --in-view keeps only the pieces whose bounds the frustum of this camera touches: a scene
that has nothing to cull by frustum.
"""

import argparse
import copy
import json
import math
import os
import shutil

import numpy

COMPONENTS = {5120: 'i1', 5121: 'u1', 5122: '<i2', 5123: '<u2', 5125: '<u4', 5126: '<f4'}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4}


def matrix_of(node):
    if 'matrix' in node:
        return numpy.array(node['matrix'], float).reshape(4, 4).T
    x, y, z, w = node.get('rotation', (0, 0, 0, 1))
    norm = math.sqrt(x * x + y * y + z * z + w * w)
    x, y, z, w = x / norm, y / norm, z / norm, w / norm
    matrix = numpy.identity(4)
    matrix[:3, :3] = numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                                  [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                                  [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    matrix[:3, :3] *= numpy.array(node.get('scale', (1, 1, 1)))
    matrix[:3, 3] = node.get('translation', (0, 0, 0))
    return matrix


def world_matrices(scene):
    """The world matrix of each node; identity for nodes that the scene does not show."""
    matrices = [numpy.identity(4) for _ in scene['nodes']]

    def visit(index, parent):
        matrices[index] = parent @ matrix_of(scene['nodes'][index])
        for child in scene['nodes'][index].get('children', ()):
            visit(child, matrices[index])

    for root in scene['scenes'][scene.get('scene', 0)]['nodes']:
        visit(root, numpy.identity(4))
    return matrices


def corners_of(scene, primitive):
    """The corners of the bounds of a primitive's positions, as columns."""
    bounds = scene['accessors'][primitive['attributes']['POSITION']]
    return numpy.array([[(bounds['min'], bounds['max'])[c >> axis & 1][axis] for axis in range(3)] + [1.0]
                        for c in range(8)]).T


class Pieces:
    """Cuts meshes into pieces, whose vertices and indices it collects in one buffer."""

    def __init__(self, scene, folder, most_triangles):
        self.scene, self.folder, self.most_triangles = scene, folder, most_triangles
        self.data = bytearray()
        self.buffer = len(scene['buffers'])
        self.files, self.made = {}, {}

    def rows(self, index):
        """The elements of an accessor, as rows of an array."""
        accessor = self.scene['accessors'][index]
        view = self.scene['bufferViews'][accessor['bufferView']]
        uri = self.scene['buffers'][view['buffer']]['uri']
        if uri not in self.files:
            with open(os.path.join(self.folder, uri), 'rb') as file:
                self.files[uri] = file.read()
        kind, width = numpy.dtype(COMPONENTS[accessor['componentType']]), WIDTHS[accessor['type']]
        start = view.get('byteOffset', 0) + accessor.get('byteOffset', 0)
        stride = view.get('byteStride', kind.itemsize * width)
        return numpy.ndarray((accessor['count'], width), kind, self.files[uri], start, (stride, kind.itemsize))

    def add(self, rows, like, target):
        """Adds an accessor for these rows. like: the accessor that they are from."""
        self.data += bytes(-len(self.data) % 4)
        data = numpy.ascontiguousarray(rows).tobytes()
        self.scene['bufferViews'].append(
            {'buffer': self.buffer, 'byteOffset': len(self.data), 'byteLength': len(data), 'target': target})
        self.data += data
        accessor = {key: value for key, value in like.items() if key not in ('byteOffset', 'min', 'max')}
        accessor.update(bufferView=len(self.scene['bufferViews']) - 1, count=len(rows))
        if like['type'] == 'VEC3':
            accessor.update(min=rows.min(axis=0).tolist(), max=rows.max(axis=0).tolist())
        self.scene['accessors'].append(accessor)
        return len(self.scene['accessors']) - 1

    def of(self, mesh):
        """The numbers of the pieces of a mesh."""
        if mesh in self.made:
            return self.made[mesh]
        accessors, pieces = self.scene['accessors'], []
        for primitive in self.scene['meshes'][mesh]['primitives']:
            indices = self.rows(primitive['indices'])[:, 0]
            for first in range(0, len(indices), 3 * self.most_triangles):
                used, local = numpy.unique(indices[first:first + 3 * self.most_triangles], return_inverse=True)
                piece = {key: value for key, value in primitive.items() if key not in ('indices', 'attributes')}
                local = local.astype(indices.dtype).reshape(-1, 1)
                piece['indices'] = self.add(local, accessors[primitive['indices']], 34963)
                piece['attributes'] = {name: self.add(self.rows(index)[used], accessors[index], 34962)
                                       for name, index in primitive['attributes'].items()}
                pieces.append(len(self.scene['meshes']))
                self.scene['meshes'].append({'primitives': [piece]})
        self.made[mesh] = pieces
        return pieces


def cut(scene, folder, most_triangles):
    """Replaces each mesh without a skin by its pieces, which become children of its node. Returns their buffer."""
    pieces = Pieces(scene, folder, most_triangles)
    for node in list(scene['nodes']):
        grows_grass = any(key.startswith('gloam.grass') for key in node.get('extras', {}))
        if 'mesh' not in node or 'skin' in node or grows_grass:
            continue
        children = node.setdefault('children', [])
        for piece in pieces.of(node.pop('mesh')):
            children.append(len(scene['nodes']))
            scene['nodes'].append({'mesh': piece})
    return bytes(pieces.data)


def bounds_of(scene):
    low, high = numpy.full(3, numpy.inf), numpy.full(3, -numpy.inf)
    for node, matrix in zip(scene['nodes'], world_matrices(scene)):
        if 'mesh' not in node or 'skin' in node:
            continue
        for primitive in scene['meshes'][node['mesh']]['primitives']:
            points = (matrix @ corners_of(scene, primitive))[:3]
            low, high = numpy.minimum(low, points.min(axis=1)), numpy.maximum(high, points.max(axis=1))
    return low, high


def plain(node):
    return {key: value for key, value in node.items() if key not in ('extras', 'extensions', 'camera')}


def repeat(scene, copies):
    low, high = bounds_of(scene)
    step = high - low
    across = max(1, round(math.sqrt(copies * step[2] / step[0])))
    nodes, skins = len(scene['nodes']), len(scene.get('skins', ()))
    animations = copy.deepcopy(scene.get('animations', []))
    roots = list(scene['scenes'][scene.get('scene', 0)]['nodes'])
    for number in range(1, copies):
        shift = nodes * number
        for node in scene['nodes'][:nodes]:
            node = copy.deepcopy(plain(node))
            if 'children' in node:
                node['children'] = [child + shift for child in node['children']]
            if 'skin' in node:
                node['skin'] += skins * number
            scene['nodes'].append(node)
        for skin in scene.get('skins', [])[:skins]:
            skin = copy.deepcopy(skin)
            skin['joints'] = [joint + shift for joint in skin['joints']]
            if 'skeleton' in skin:
                skin['skeleton'] += shift
            scene['skins'].append(skin)
        for animation, source in zip(scene.get('animations', []), animations):
            first = len(animation['samplers'])
            animation['samplers'] += copy.deepcopy(source['samplers'])
            for channel in copy.deepcopy(source['channels']):
                channel['sampler'] += first
                if 'node' in channel['target']:
                    channel['target']['node'] += shift
                animation['channels'].append(channel)
    for number in range(1, copies):
        column, row = number % across, number // across
        scene['nodes'].append({'translation': [float(-column * step[0]), 0.0, float(row * step[2])],
                               'children': [root + nodes * number for root in roots]})
        scene['scenes'][scene.get('scene', 0)]['nodes'].append(len(scene['nodes']) - 1)


def keep_in_view(scene, camera, aspect):
    """Removes the pieces that the camera's frustum does not touch. Skinned meshes stay."""
    matrices = world_matrices(scene)
    index = next(i for i, node in enumerate(scene['nodes']) if 'camera' in node and node.get('name') == camera)
    lens = scene['cameras'][scene['nodes'][index]['camera']]['perspective']
    view = numpy.linalg.inv(matrices[index])
    up = math.tan(lens['yfov'] / 2)
    planes = numpy.array([[1, 0, -up * aspect, 0], [-1, 0, -up * aspect, 0], [0, 1, -up, 0], [0, -1, -up, 0],
                          [0, 0, -1, 0]])
    for node, matrix in zip(scene['nodes'], matrices):
        if 'mesh' not in node or 'skin' in node:
            continue
        points = view @ matrix @ corners_of(scene, scene['meshes'][node['mesh']]['primitives'][0])
        if ((planes @ points).max(axis=1) < 0).any():
            del node['mesh']


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('source')
    parser.add_argument('out')
    parser.add_argument('--copies', type=int, default=40)
    parser.add_argument('--piece', type=int, default=448)
    parser.add_argument('--in-view')
    parser.add_argument('--aspect', type=float, default=16 / 9)
    options = parser.parse_args()
    folder = os.path.dirname(os.path.abspath(options.source))
    with open(options.source) as file:
        scene = json.load(file)
    data = cut(scene, folder, options.piece)
    repeat(scene, options.copies)
    if options.in_view:
        keep_in_view(scene, options.in_view, options.aspect)
    out = os.path.abspath(options.out)
    named = [item.get('uri') for item in scene['buffers'] + scene.get('images', [])]
    named += [value for node in scene['nodes'] for value in node.get('extras', {}).values() if isinstance(value, str)]
    for name in filter(None, named):
        if os.path.isfile(os.path.join(folder, name)):
            os.makedirs(os.path.dirname(os.path.join(os.path.dirname(out), name)), exist_ok=True)
            shutil.copyfile(os.path.join(folder, name), os.path.join(os.path.dirname(out), name))
    scene['buffers'].append({'uri': os.path.basename(out) + '.bin', 'byteLength': len(data)})
    with open(out + '.bin', 'wb') as file:
        file.write(data)
    with open(out, 'w') as file:
        json.dump(scene, file)
    shown = [mesh for mesh in (node.get('mesh') for node in scene['nodes']) if mesh is not None]
    triangles = sum(scene['accessors'][primitive['indices']]['count'] // 3
                    for mesh in shown for primitive in scene['meshes'][mesh]['primitives'])
    print(f'{out}: {len(shown)} meshes, {triangles} triangles')


if __name__ == '__main__':
    main()
