#pragma once
#include "own_Wire.h"
#define QB 4
