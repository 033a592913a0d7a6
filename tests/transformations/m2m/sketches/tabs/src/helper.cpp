#include "helper.h"

int helper() { return 1; }
