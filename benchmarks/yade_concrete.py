# YADE's concrete particle model (damage in tension, plasticity in shear) on a packing, for timing.
# Environment: PACKING file of 'x y z r' lines; RANGE interaction range; SECONDS to measure.
# Run by: yade -n -x -jTHREADS yade_concrete.py
import os
import sys
import time

spheres = [tuple(float(v) for v in line.split()[:4]) for line in open(os.environ["PACKING"])]
reach = float(os.environ["RANGE"])
concrete = O.materials.append(
    CpmMat(young=28e9, poisson=0.2, density=2500, frictionAngle=0.7, sigmaT=4e6, relDuctility=30, epsCrackOnset=1e-4))
O.bodies.append([utils.sphere((x, y, z), r, material=O.materials[concrete]) for x, y, z, r in spheres])
ends = utils.uniaxialTestFeatures(axis=2)
mean = sum(s[3] for s in spheres) / len(spheres)
O.dt = 0.5 * utils.PWaveTimeStep()
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=reach, label="boxes")], verletDist=0.05 * mean),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(interactionDetectionFactor=reach, label="geometry")],
        [Ip2_CpmMat_CpmMat_CpmPhys()],
        [Law2_ScGeom_CpmPhys_Cpm()]),
    NewtonIntegrator(damping=0.4),
    UniaxialStrainer(strainRate=-0.05, axis=2, asymmetry=0, posIds=ends["posIds"], negIds=ends["negIds"],
                     crossSectionArea=ends["area"], blockDisplacements=False, blockRotations=False, setSpeeds=True),
]
O.step()  # makes the bonds; from now on only touching spheres meet anew
geometry.interactionDetectionFactor = 1.0
boxes.aabbEnlargeFactor = 1.0
bonds = sum(1 for _ in O.interactions)
O.run(40, True)
begin = time.time()
O.run(40, True)
steps = max(40, int(float(os.environ["SECONDS"]) * 40 / (time.time() - begin)))
begin = time.time()
O.run(steps, True)
wall = time.time() - begin
print("bonds %d steps %d ns_per_bond_step %.3f" % (bonds, steps, 1e9 * wall / steps / bonds))
sys.stdout.flush()
os._exit(0)  # YADE's own exit is slow and noisy
