# blender -b --python scripts/render_in_blender.py -- FILE.glb OUT.exr WIDTHxHEIGHT x,y,z [x,y,z ...]
# A .glb of `nacre export --gltf` as Blender's Cycles shows it: from the front, one metre wide, under distant lights of irradiance 1
# without their shadows and without bounces, in linear radiance, as `nacre render --light x,y,z ... -o OUT.exr` has it.
import sys

import bpy
import numpy
from mathutils import Vector

numpy.bool = bool  # Debian 12's Blender 3.4 imports glTF by a name that its numpy has dropped

glb, out, size, *lights = sys.argv[sys.argv.index('--') + 1:]
width, height = (int(side) for side in size.split('x'))

bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=glb)
scene = bpy.context.scene


def from_gltf(v):  # y up to Blender's z up
    return Vector((v[0], -v[2], v[1]))


def look_along(name, data, towards):
    thing = bpy.data.objects.new(name, data)
    thing.rotation_euler = towards.to_track_quat('-Z', 'Z' if abs(towards.z) < 0.99 else 'Y').to_euler()
    scene.collection.objects.link(thing)
    return thing


camera = bpy.data.cameras.new('camera')
camera.type = 'ORTHO'
camera.ortho_scale = max(1.0, height / width)
camera.clip_end = 1000
placed = look_along('camera', camera, from_gltf((0, 0, -1)))
placed.location = from_gltf((0, 0, 100))
scene.camera = placed

for i, text in enumerate(lights):
    direction = Vector([float(x) for x in text.split(',')]).normalized()
    sun = bpy.data.lights.new(f'sun {i}', 'SUN')
    sun.energy = 1.0
    sun.angle = 0.0
    sun.cycles.cast_shadow = False
    look_along(f'sun {i}', sun, -from_gltf(direction))

world = bpy.data.worlds.new('black')
world.use_nodes = True
world.node_tree.nodes['Background'].inputs['Strength'].default_value = 0
scene.world = world
scene.render.engine = 'CYCLES'
scene.cycles.device = 'CPU'
scene.cycles.samples = 16
scene.cycles.max_bounces = 0
scene.cycles.transparent_max_bounces = 8
scene.cycles.pixel_filter_type = 'BOX'
scene.cycles.filter_width = 1.0
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
scene.render.film_transparent = True
scene.view_settings.view_transform = 'Raw'
scene.render.image_settings.file_format = 'OPEN_EXR'
scene.render.image_settings.color_depth = '32'
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
