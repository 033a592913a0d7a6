/* What the programs use of the platform's library, for the machine that the tests run on. */
#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define pause(milliseconds) ((void)(milliseconds))
#define print printf
