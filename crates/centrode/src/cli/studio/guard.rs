use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

/// Guard that admits only requests of this page: they must use its secret address and this computer's own name.
#[derive(Clone)]
pub(crate) struct Guard {
    port: u16,
    token: Arc<str>,
}

/// Flag that is set once a connection has used the secret address.
#[derive(Clone, Default)]
pub(crate) struct Known(pub(crate) Arc<AtomicBool>);

/// Content-Security-Policy of every answer.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; \
                      connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

const HEADERS: [(HeaderName, &str); 6] = [
    (header::CONTENT_SECURITY_POLICY, POLICY),
    (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
    (header::REFERRER_POLICY, "no-referrer"),
    (header::CACHE_CONTROL, "no-store"),
    (
        HeaderName::from_static("cross-origin-resource-policy"),
        "same-origin",
    ),
    (
        HeaderName::from_static("cross-origin-opener-policy"),
        "same-origin",
    ),
];

impl Guard {
    /// Makes a guard with a new secret of 128 random bits.
    pub(crate) fn new(port: u16) -> io::Result<Self> {
        let mut bytes = [0_u8; 16];
        getrandom::fill(&mut bytes).map_err(|error| io::Error::other(error.to_string()))?;
        let token: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Self {
            port,
            token: token.into(),
        })
    }

    /// First part of every path.
    pub(crate) fn base(&self) -> String {
        format!("/{}", self.token)
    }

    /// Address of the page.
    pub(crate) fn url(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token)
    }

    /// Reason why a request is refused, if it is.
    fn refusal(&self, method: &Method, path: &str, headers: &HeaderMap) -> Option<&'static str> {
        // If there were two values, another reader of the request might use the other one.
        let is_single = |name| headers.get_all(name).iter().count() < 2;
        if !(is_single(header::HOST) && is_single(header::ORIGIN)) {
            return Some("the request has two host or origin headers");
        }
        let names = ["127.0.0.1", "localhost"].map(|name| format!("{name}:{}", self.port));
        let host = headers.get(header::HOST).and_then(|h| h.to_str().ok());
        // A page of another site could reach this server by a foreign name that resolves to this computer.
        if !host.is_some_and(|host| names.iter().any(|name| name == host)) {
            return Some("the page does not answer to this host name");
        }
        let own = |origin: &HeaderValue| {
            let origin = origin.to_str().ok().and_then(|o| o.strip_prefix("http://"));
            origin.is_some_and(|origin| names.iter().any(|name| name == origin))
        };
        match headers.get(header::ORIGIN) {
            Some(origin) if !own(origin) => return Some("requests from another site are refused"),
            // Browsers send the origin with every request except plain reads.
            None if *method != Method::GET => return Some("the request has no origin header"),
            _ => {}
        }
        let given = path
            .strip_prefix('/')
            .and_then(|rest| rest.split('/').next())
            .unwrap_or("");
        if !same(given.as_bytes(), self.token.as_bytes()) {
            return Some(
                "the address does not contain the secret: use the address that centrode studio printed",
            );
        }
        None
    }
}

/// Compares in constant time, so that the duration does not reveal where two texts differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |found, (x, y)| found | (x ^ y)) == 0
}

/// Lets a request through, or refuses it; puts the policy on every answer.
pub(crate) async fn pass(State(guard): State<Guard>, request: Request, next: Next) -> Response {
    let refusal = guard.refusal(request.method(), request.uri().path(), request.headers());
    let mut response = match refusal {
        Some(reason) => (StatusCode::FORBIDDEN, reason).into_response(),
        None => {
            if let Some(Known(known)) = request.extensions().get::<Known>() {
                known.store(true, Ordering::Relaxed);
            }
            next.run(request).await
        }
    };
    for (name, value) in HEADERS {
        response
            .headers_mut()
            .insert(name, HeaderValue::from_static(value));
    }
    response
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(method: Method, path: &str, headers: &[(HeaderName, &'static str)]) -> bool {
        let guard = Guard {
            port: 4711,
            token: "secret".into(),
        };
        let mut map = HeaderMap::new();
        for (name, value) in headers {
            map.append(name, HeaderValue::from_static(value));
        }
        guard.refusal(&method, path, &map).is_none()
    }

    #[test]
    fn only_the_page_itself_may_ask() {
        let host = (header::HOST, "127.0.0.1:4711");
        let own = (header::ORIGIN, "http://127.0.0.1:4711");
        assert!(answer(Method::GET, "/secret/", std::slice::from_ref(&host)));
        assert!(answer(
            Method::POST,
            "/secret/save",
            &[host.clone(), own.clone()]
        ));
        assert!(answer(
            Method::GET,
            "/secret/",
            &[(header::HOST, "localhost:4711")]
        ));
        for path in [
            "/",
            "/secre/",
            "/secrets/",
            "/Secret/",
            "/../secret/",
            "//secret/",
            "secret/",
        ] {
            assert!(
                !answer(Method::GET, path, std::slice::from_ref(&host)),
                "{path}"
            );
        }
        for name in [
            "example.org:4711",
            "127.0.0.1",
            "127.0.0.1:80",
            "127.0.0.1:4711.example.org",
            "",
        ] {
            assert!(
                !answer(Method::GET, "/secret/", &[(header::HOST, name)]),
                "{name}"
            );
        }
        assert!(!answer(Method::GET, "/secret/", &[]));
        for origin in [
            "http://example.org",
            "null",
            "https://127.0.0.1:4711",
            "http://127.0.0.1:4712",
            "",
        ] {
            for method in [Method::GET, Method::POST] {
                assert!(
                    !answer(
                        method,
                        "/secret/",
                        &[host.clone(), (header::ORIGIN, origin)]
                    ),
                    "{origin}"
                );
            }
        }
        assert!(!answer(
            Method::POST,
            "/secret/save",
            std::slice::from_ref(&host)
        ));
        assert!(!answer(
            Method::DELETE,
            "/secret/keep",
            std::slice::from_ref(&host)
        ));
    }

    #[test]
    fn a_host_or_origin_given_twice_is_refused() {
        let (good, other) = ("127.0.0.1:4711", "localhost:4711");
        let own = "http://127.0.0.1:4711";
        let table: [(&[&str], &[&str], bool); 12] = [
            (&[good], &[own], true),
            (&[other], &[own], true),
            (&[good, good], &[own], false),
            (&[good, other], &[own], false),
            (&[good, "example.org"], &[own], false),
            (&["example.org", good], &[own], false),
            (&[good, ""], &[own], false),
            (&["", good], &[own], false),
            (&[good, good, good], &[own], false),
            (&[good, "127.0.0.1"], &[own], false),
            (&[good], &[own, own], false),
            (&[good], &[own, "http://example.org"], false),
        ];
        for (hosts, origins, is_let_in) in table {
            let hosts = hosts.iter().map(|&host| (header::HOST, host));
            let origins = origins.iter().map(|&origin| (header::ORIGIN, origin));
            let headers: Vec<_> = hosts.chain(origins).collect();
            for method in [Method::GET, Method::POST] {
                let path = "/secret/save";
                assert_eq!(answer(method, path, &headers), is_let_in, "{headers:?}");
            }
        }
    }

    #[test]
    fn secrets_differ() {
        let [a, b] = [0, 1].map(|_| Guard::new(1).expect("random"));
        assert_ne!(a.token, b.token);
        assert_eq!(a.token.len(), 32);
    }
}
