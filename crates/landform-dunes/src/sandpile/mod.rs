//! Piles that relax by avalanches: self-organised criticality (thesis, sections 2.2 and 3.1.3).
