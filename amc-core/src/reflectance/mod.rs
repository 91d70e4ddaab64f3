//! What a cloth reflects: formulas and data an AMC is baked from.
