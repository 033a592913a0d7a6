/* Registers of a cog, as propgcc's cog.h names them. */
#ifndef ROBOSMI_COG_H
#define ROBOSMI_COG_H
#include "host.h"
#define _COGMEM
#define _NATIVE
#define _NAKED
#define _FCACHE
#define _CNT (host_counter())
#define _INA (host_pins())
#define _OUTA (*host_register(HOST_OUTA))
#define _DIRA (*host_register(HOST_DIRA))
#define _CTRA (*host_register(HOST_CTRA))
#define _CTRB (*host_register(HOST_CTRB))
#define _FRQA (*host_register(HOST_FRQA))
#define _FRQB (*host_register(HOST_FRQB))
#define _PHSA (*host_register(HOST_PHSA))
#define _PHSB (*host_register(HOST_PHSB))
#define _INB 0u
#define _OUTB (*host_register(HOST_OTHER))
#define _DIRB (*host_register(HOST_OTHER + 1))
#define _VCFG (*host_register(HOST_OTHER + 2))
#define _VSCL (*host_register(HOST_OTHER + 3))
#define _PAR (*host_register(HOST_OTHER + 4))
extern unsigned int _clkfreq;
extern unsigned char _clkmode;
#define _CLKFREQ _clkfreq
#define _CLKMODE _clkmode
#endif
