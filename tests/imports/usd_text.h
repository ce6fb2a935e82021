// Texts of USD files for tests.
#pragma once

#include <string>

namespace scree::imported {

inline std::string usda(const std::string& prims, const std::string& metadata = "metersPerUnit = 1") {
    return "#usda 1.0\n(\n" + metadata + "\n)\n" + prims;
}
// A prim that moves, with a collider of its own.
inline std::string rigid(const std::string& type, const std::string& name, const std::string& inside,
                         const std::string& schemas = "") {
    return "def " + type + " \"" + name + "\" (prepend apiSchemas = [\"PhysicsRigidBodyAPI\", \"PhysicsCollisionAPI\"" + schemas +
           "]) {\n" + inside + "\n}\n";
}
inline std::string solid(const std::string& type, const std::string& name, const std::string& inside) {
    return "def " + type + " \"" + name + "\" (prepend apiSchemas = [\"PhysicsCollisionAPI\"]) {\n" + inside + "\n}\n";
}
inline std::string at(const std::string& place) {
    return "double3 xformOp:translate = " + place + "\nuniform token[] xformOpOrder = [\"xformOp:translate\"]\n";
}

// A hinge, a prismatic joint, a mesh, groups, a material and more, in centimetres, z up.
inline const std::string everything_usda = R"(#usda 1.0
(
    "A comment"
    defaultPrim = "World"
    metersPerUnit = 0.01
    upAxis = "Z"
    startTimeCode = 1
    timeCodesPerSecond = 24
    customLayerData = { string made = "by hand"; dictionary inner = { double x = 3 } }
)

def Xform "World"
{
    def PhysicsScene "physics" { vector3f physics:gravityDirection = (0, 0, -1); float physics:gravityMagnitude = 981 }
    def Plane "ground" (prepend apiSchemas = ["PhysicsCollisionAPI", "MaterialBindingAPI"])
    {
        uniform token axis = "Z"
        rel material:binding:physics = </World/rubber>
    }
    def Material "rubber" (prepend apiSchemas = ["PhysicsMaterialAPI"])
    {
        float physics:staticFriction = 0.9
        float physics:dynamicFriction = 0.7
        float physics:restitution = 0.25
        float physics:density = 0.002
    }
    def Xform "set" (
        prepend references = [</World/parts> (offset = 2)]
        variants = { string look = "red" }
        prepend variantSets = "look"
    )
    {
        double3 xformOp:translate = (0, 0, 100)
        float3 xformOp:rotateXYZ = (0, 0, 90)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
        variantSet "look" = {
            "red" { over "lid" { color3f[] primvars:displayColor = [(1, 0, 0)] } }
            "blue" { over "lid" { color3f[] primvars:displayColor = [(0, 0, 1)] } }
        }
    }
    class Xform "parts"
    {
        def Cube "lid" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMassAPI"])
        {
            double size = 20
            float physics:mass = 2
            vector3f physics:velocity = (100, 0, 0)
            vector3f physics:angularVelocity = (0, 0, 90)
            rel material:binding:physics = </World/rubber>
            double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 4: (0, 40, 0) }
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def Mesh "wedge" (prepend apiSchemas = ["PhysicsRigidBodyAPI", "PhysicsCollisionAPI", "PhysicsMeshCollisionAPI"])
        {
            uniform token physics:approximation = "convexHull"
            int[] faceVertexCounts = [3, 3, 4, 4, 4]
            int[] faceVertexIndices = [0, 2, 1, 3, 4, 5, 0, 1, 4, 3, 1, 2, 5, 4, 2, 0, 3, 5]
            point3f[] points = [(0, 0, 0), (30, 0, 0), (0, 30, 0), (0, 0, 40), (30, 0, 40), (0, 30, 40)]
            double3 xformOp:translate = (200, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def PhysicsRevoluteJoint "hinge" (prepend apiSchemas = ["PhysicsDriveAPI:angular"])
        {
            rel physics:body0 = </World/parts/lid>
            rel physics:body1 = <../wedge>
            uniform token physics:axis = "Z"
            float physics:lowerLimit = -45
            float physics:upperLimit = 90
            float drive:angular:physics:stiffness = 1000
            float drive:angular:physics:damping = 20
            float drive:angular:physics:targetPosition = 30
            point3f physics:localPos0 = (100, 0, 0)
            point3f physics:localPos1 = (-100, -40, 0)
        }
    }
    def PhysicsCollisionGroup "solo" (prepend apiSchemas = ["CollectionAPI:colliders"])
    {
        rel collection:colliders:includes = [</World/set/lid>]
        rel physics:filteredGroups = [</World/solo>]
    }
}
)";

}  // namespace scree::imported
