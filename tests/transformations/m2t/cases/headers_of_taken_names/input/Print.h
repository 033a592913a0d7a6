#pragma once
#include "Wire.h"
#define QB 4
