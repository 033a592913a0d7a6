/* colorpal.h of the Simple Libraries: a sensor of colours on one wire. */
#ifndef ROBOSMI_COLORPAL_H
#define ROBOSMI_COLORPAL_H
#include "simpletools.h"
#include "fdserial.h"
typedef fdserial_st colorPal_t;
typedef text_t colorPal;
colorPal *colorPal_open(int sioPin);
void colorPal_close(colorPal *device);
void colorPal_getRGB(colorPal *device, int *r, int *g, int *b);
unsigned int colorPalRRGGBB(int r, int g, int b);
#endif
