#include "simpletools.h"
