/* Names of the registers in a program, as propgcc's propeller1.h has them, and its functions for single pins. */
#ifndef ROBOSMI_PROPELLER1_H
#define ROBOSMI_PROPELLER1_H
#include "cog.h"
#define PAR _PAR
#define CNT _CNT
#define INA _INA
#define INB _INB
#define OUTA _OUTA
#define OUTB _OUTB
#define DIRA _DIRA
#define DIRB _DIRB
#define CTRA _CTRA
#define CTRB _CTRB
#define FRQA _FRQA
#define FRQB _FRQB
#define PHSA _PHSA
#define PHSB _PHSB
#define VCFG _VCFG
#define VSCL _VSCL
#define getcnt() _CNT
#define coginit(id, code, parameter) (host_unmodelled("coginit"), 0)
int getpin(int pin);
void setpin(int pin, int value);
void togglepin(int pin);
#endif
