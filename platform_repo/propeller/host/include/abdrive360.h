/* abdrive360.h of the Simple Libraries: the drive of the ActivityBot with servos that tell their angle. abdrive.h has functions of the same
 * names: which is meant is said by the header that a program includes. */
#ifndef ABDRIVE360_H
#define ABDRIVE360_H
#include "simpletools.h"
#include "servo360.h"
#define ABD360_GOTO_BUSY 1
#define ABD360_GOTO_CLEAR 0
#define ABD360_GOTO_BLOCK 0
#define ABD360_GOTO_SET_FORGET 1
#define AB360_NEITHER 0
#define AB360_LEFT 1
#define AB360_RIGHT 2
#define FOR_GOTO 1
#define FOR_SPEED 0
#define OFF 0
#define ON 1
#define SIDE_LEFT 0
#define SIDE_RIGHT 1
#define SIDE_BOTH 2
#define ABD360_UNITS_REV 64
#define ABD_RAMP_STEP 12
#define ABD_SPEED_LIMIT 128
#define ABD_GOTO_SPEED_LIMIT 64
#define ABD_GOTO_RAMP_STEP 8
#define _AB360_EE_Start_ 63418
#define _AB360_EE_Pins_ 12
#define drive_init abdrive360_drive_init
#define drive_speed abdrive360_drive_speed
#define drive_goto abdrive360_drive_goto
#define drive_getTicks abdrive360_drive_getTicks
#define drive_getTicksCalc abdrive360_drive_getTicksCalc
#define drive_servoPins abdrive360_drive_servoPins
#define drive_encoderPins abdrive360_drive_encoderPins
#define drive_setMaxVelocity abdrive360_drive_setMaxVelocity
#define drive_setAcceleration abdrive360_drive_setAcceleration
#define drive_gotoMode abdrive360_drive_gotoMode
#define drive_gotoStatus abdrive360_drive_gotoStatus
#define drive_feedback abdrive360_drive_feedback
#define drive_suppress_eeprom abdrive360_drive_suppress_eeprom
#define drive_setMaxSpeed abdrive360_drive_setMaxSpeed
#define drive_setRampStep abdrive360_drive_setRampStep
#define drive_rampStep abdrive360_drive_rampStep
#define drive_ramp abdrive360_drive_ramp
void drive_init(void);
void drive360_unitsPerRev(int units);
void drive_speed(int left, int right);
void drive_goto(int distLeft, int distRight);
void drive_getTicks(int *left, int *right);
void drive_getTicksCalc(int *left, int *right);
void drive_servoPins(int controlPinLeft, int controlPinRight);
void drive_encoderPins(int encPinLeft, int encPinRight);
void drive_setMaxVelocity(int forGotoOrSpeed, int ticksPerSec);
void drive_setAcceleration(int forGotoOrSpeed, int ticksPerSecSq);
void drive_gotoMode(int mode);
int drive_gotoStatus(int side);
void drive_feedback(int enabled);
void drive_suppress_eeprom(int state);
void drive_setMaxSpeed(int speed);
void drive_setRampStep(int stepsize);
void drive_rampStep(int left, int right);
void drive_ramp(int left, int right);
void drive360_ticksPerRev(int units);
#endif
