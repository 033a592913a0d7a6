/* soundimpact.h of the Simple Libraries: a sensor that makes a pulse for each loud sound. */
#ifndef ROBOSMI_SOUNDIMPACT_H
#define ROBOSMI_SOUNDIMPACT_H
#include "simpletools.h"
int *soundImpact_run(int pin);
void soundImpact_end(int *processID);
int soundImpact_getCount(void);
#endif
