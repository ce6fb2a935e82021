// Vehicle presets: add the bodies, joints and vehicle (compute/scene.h) of a car to a scene.
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
    vec3 position{0};                          // ground point below the centre between its wheels, m
    float heading = 0;                         // rad, about y; 0: along z, pi/2: along x
    float speed = 0;                           // initial forward speed, m/s; the wheels turn with it
    float size = 1;                            // scales all lengths; 1: wheels of 0.33 m, wheelbase 2.6 m
    float density = 1;                         // scales all densities; 1: 1,250 kg
    float friction = 1;                        // of its tyres, as Body::friction
    Tyre tyre{};                               //
    float hertz = 1.5f, damping_ratio = 0.4f;  // of the suspension
    float brake = 1;                           // scales the brakes; with 1 the front wheels just lock at friction 1
    Engine engine{};
    Steering steering{};
};
// Returns the index of the vehicle. The chassis and wheels are the scene's last bodies: chassis, front left, front
// right, rear left, rear right.
std::size_t add_car(Scene& scene, const Car& car);

// A simple cart: a box with four hinged wheels, without suspension or steering; it skid-steers like a tank.
struct Cart {
    std::string name = "cart";
    vec3 position{0};   // as Car::position
    float heading = 0;  // rad
    float friction = 1;
    float brake = 1;  // scales the brakes
    Tyre tyre{};
    Engine engine{2000, 15000, 6, 6, 5};
};
std::size_t add_cart(Scene& scene, const Cart& cart);

}  // namespace scree
