//! Pictures of a turning ball made into an AMC (paper, section 5).
