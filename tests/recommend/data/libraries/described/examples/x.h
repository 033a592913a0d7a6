#include <never.h>
