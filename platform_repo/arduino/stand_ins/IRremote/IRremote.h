// Stand-in: the name that versions before 4 are included by.
#include "IRremote.hpp"
