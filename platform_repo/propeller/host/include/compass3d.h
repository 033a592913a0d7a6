/* compass3d.h of the Simple Libraries: a compass of three axes on the two-wire bus. */
#ifndef ROBOSMI_COMPASS3D_H
#define ROBOSMI_COMPASS3D_H
#include "simplei2c.h"
#include "simpletools.h"
void compass_init(i2c *bus);
void compass_read(i2c *bus, int *px, int *py, int *pz);
#endif
