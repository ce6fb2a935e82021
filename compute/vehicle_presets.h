// Cars put together: the bodies, joints and the vehicle (compute/scene.h) of one, added to a scene.
//
//     scree::Scene scene;
//     scene.bodies.push_back(ground);
//     const std::size_t car = scree::add_car(scene, {.position = {0, 0, 0}});
//     scree::World world(scene);
//     world.drive(car, {.throttle = 1});
#pragma once

#include <cstddef>
#include <string>

#include "compute/scene.h"

namespace scree {

// Four wheels with springs, dampers and tyres; the front ones are steered, the rear ones driven, all braked.
struct Car {
    std::string name = "car";
    vec3 position{0};                          // on the ground, below the middle between its wheels, m
    float heading = 0;                         // rad, about y; 0: along z, pi/2: along x
    float speed = 0;                           // m/s, ahead, at the start; its wheels turn with it
    float size = 1;                            // of all lengths; 1: wheels of 0.33 m, 2.6 m between its axles
    float density = 1;                         // of all densities; 1: 1,250 kg
    float friction = 1;                        // of its tyres, as Body has it
    Tyre tyre{};                               //
    float hertz = 1.5f, damping_ratio = 0.4f;  // of its springs
    float brake = 1;                           // of the brakes' torque; with 1 the front wheels just lock where friction is 1
    Engine engine{};
    Steering steering{};
};
// Index of the vehicle. Its chassis and wheels are the scene's last bodies: chassis, front left, front right, rear left, rear
// right.
std::size_t add_car(Scene& scene, const Car& car);

// The plain form: a box with four hinged wheels, without springs or steering; it turns as a tank does.
struct Cart {
    std::string name = "cart";
    vec3 position{0};   // as of Car
    float heading = 0;  // rad
    float friction = 1;
    float brake = 1;  // of the brakes' torque
    Tyre tyre{};
    Engine engine{2000, 15000, 6, 6, 5};
};
std::size_t add_cart(Scene& scene, const Cart& cart);

}  // namespace scree
