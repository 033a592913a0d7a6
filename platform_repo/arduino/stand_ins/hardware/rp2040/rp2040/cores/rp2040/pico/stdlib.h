#pragma once
#include "../hardware/gpio.h"
#include "time.h"
