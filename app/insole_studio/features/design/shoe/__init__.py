"""The shoe that the insole has to fit."""
