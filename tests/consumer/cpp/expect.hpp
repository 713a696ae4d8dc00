// What the C++ checks share: every failure is told and counted.

#pragma once

#include <bladesmith/bladesmith.hpp>

#include <cmath>
#include <iostream>
#include <string>

inline int failures = 0;

inline void expect(bool holds, const std::string &what)
{
    if (!holds) {
        std::cerr << "does not hold: " << what << '\n';
        failures++;
    }
}

inline void expect_near(double value, double expected, const std::string &what, double tolerance = 1e-9)
{
    expect(std::abs(value - expected) < tolerance, what + ": " + std::to_string(value) + " is not " + std::to_string(expected));
}

template <class Call> void expect_error(std::int32_t status, const std::string &part, Call call)
{
    try {
        call();
        expect(false, "an error that says '" + part + "'");
    } catch (const bladesmith::Error &error) {
        expect(error.status() == status && std::string(error.what()).find(part) != std::string::npos,
               "status " + std::to_string(status) + " with '" + part + "' in: " + error.what());
    }
}
