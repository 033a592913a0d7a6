/* abdrive.h of the Simple Libraries: the drive of the ActivityBot. */
#ifndef ABDRIVE_H
#define ABDRIVE_H
#include "simpletools.h"
#include "simpletext.h"
#include "fdserial.h"
#define ABD_RAMP_STEP 12
#define ABD_SPEED_LIMIT 128
#define ABD_GOTO_SPEED_LIMIT 64
#define ABD_GOTO_RAMP_STEP 4
#define ABD_NUDGE_SPEED 4
#define ABD_STOP_50ths 5
#define FOR_GOTO 1
#define FOR_SPEED 0
#define OFF 0
#define ON 1
#define SIDE_LEFT 0
#define SIDE_RIGHT 1
#define SIDE_BOTH 2
#define AB_RIGHT 1
#define AB_LEFT -1
#define AB_FORWARD 1
#define AB_BACKWARD -1
void drive_goto(int distLeft, int distRight);
void drive_speed(int left, int right);
void drive_getTicks(int *left, int *right);
void drive_getTicksCalc(int *left, int *right);
int drive_gotoStatus(int side);
void drive_encoderPins(int encPinLeft, int encPinRight);
void drive_feedback(int enabled);
void drive_gotoMode(int mode);
void drive_servoPins(int servoPinLeft, int servoPinRight);
void drive_pins(int servoPinLeft, int servoPinRight, int encPinLeft, int encPinRight);
void drive_setAcceleration(int forGotoOrSpeed, int ticksPerSecSq);
void drive_setErrorLimit(int maxDistDiffTicks);
void drive_setMaxSpeed(int speed);
void drive_setMaxVelocity(int forGotoOrSpeed, int ticksPerSec);
void drive_setRampStep(int stepsize);
void drive_rampStep(int left, int right);
void drive_ramp(int left, int right);
#endif
