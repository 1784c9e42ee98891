use crate::drawing::{Color, Drawing, LineType};

/// Meaning of a line of a sheet; each has its layer, line type and width, ISO 128-2.
#[derive(Clone, Copy, Debug, Eq, PartialEq)]
pub enum Pen {
    /// Visible edges and outlines: thick.
    Outline,
    /// Reference outlines, broken edges: thin.
    Thin,
    /// Axes, pitch curves: thin, dash-dotted.
    Axis,
    /// Outlines of adjacent parts: thin, double-dash-dotted.
    Adjacent,
    /// Hatching of cut faces: thin.
    Hatch,
    /// Dimension, extension and leader lines and their arrow heads: thin.
    Dimension,
    /// Cutting planes: thick, dash-dotted.
    Cut,
    /// Words.
    Text,
    /// Rules of tables and of the title block: thin.
    Rule,
    /// Frame of the drawing space and centring marks.
    Frame,
}

impl Pen {
    const ALL: [Self; 10] = [
        Self::Hatch,
        Self::Axis,
        Self::Adjacent,
        Self::Thin,
        Self::Dimension,
        Self::Rule,
        Self::Text,
        Self::Cut,
        Self::Outline,
        Self::Frame,
    ];

    /// Name of the layer.
    #[must_use]
    pub fn layer(self) -> &'static str {
        match self {
            Self::Outline => "OUTLINE",
            Self::Thin => "THIN",
            Self::Axis => "CENTER",
            Self::Adjacent => "ADJACENT",
            Self::Hatch => "HATCH",
            Self::Dimension => "DIMENSION",
            Self::Cut => "CUTTING_PLANE",
            Self::Text => "TEXT",
            Self::Rule => "RULE",
            Self::Frame => "FRAME",
        }
    }

    /// Width of its lines, mm: ISO 128 line group 0.5.
    #[must_use]
    pub fn width(self) -> f64 {
        match self {
            Self::Outline | Self::Cut => 0.5,
            Self::Frame => 0.7,
            Self::Hatch => 0.18,
            _ => 0.25,
        }
    }

    fn line_type(self) -> LineType {
        match self {
            Self::Axis | Self::Cut => LineType::Center,
            Self::Adjacent => LineType::Phantom,
            _ => LineType::Continuous,
        }
    }

    /// A drawing with the layers of all pens, thin lines below thick ones.
    pub(super) fn drawing() -> Drawing {
        Self::ALL.into_iter().fold(Drawing::default(), |d, pen| {
            d.layer(pen.layer(), Color::Foreground, pen.line_type(), pen.width())
        })
    }
}
